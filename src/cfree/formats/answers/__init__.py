"""Answers in files: paths and separations, as JSON text and as pydantic models."""
