"""Vehicles: cars and differential drives, which cannot move sideways."""
