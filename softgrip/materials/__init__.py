"""Elastomers: their printed properties, their laws of stress and strain, and their public tests."""
