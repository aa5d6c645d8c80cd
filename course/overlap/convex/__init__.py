"""Two convex solids: the nearest points by GJK and EPA, the separating axes."""
