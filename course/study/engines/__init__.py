"""Other people's libraries, asked the same questions; each is imported when it is called."""
