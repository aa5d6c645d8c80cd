"""Spheres and capsules: closed forms, and contacts with a curvature."""
