"""Contact manifolds."""
