"""How the finger moves: linear and Ludwick models, identification, batches of runs."""
