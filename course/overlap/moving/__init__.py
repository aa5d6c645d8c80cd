"""Shapes in motion: when they meet, exactly in straight motion, by advancement where they turn."""
