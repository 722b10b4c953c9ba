"""How the book is built: dependency tracing, numbering, scripts for use without a network."""
