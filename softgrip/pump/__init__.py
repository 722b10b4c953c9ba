"""The syringe pump: pressure, capacity, sizing (Chapter 4)."""
