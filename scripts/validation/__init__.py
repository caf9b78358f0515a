"""Comparison with published numbers: one module for each table, and methods that the program does not use."""
