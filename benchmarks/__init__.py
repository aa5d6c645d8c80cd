"""Ratios of time, measured side by side in one run on one BLAS thread: ``python -m benchmarks``."""
