"""Checks of docs/theory.md: called by scripts/check-theory."""
