"""Chapter 2: the tactile sensor."""
