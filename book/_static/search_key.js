// Ctrl+K, or ⌘K, leads to the search page, as the theme's buttons do; there, to its field.
addEventListener("keydown", (event) => {
  if (event.key.toLowerCase() !== "k" || event.ctrlKey === event.metaKey || event.altKey || event.shiftKey) return;
  event.preventDefault();
  const field = document.getElementById("search-field");
  if (field) field.select();
  else document.querySelector("a.search-button__button")?.click();
});
