"""Weight and size in the loop: the page *Design yours*."""
