// Sets the equations of a page: Sphinx leaves their TeX between \( \) or \[ \].
document.addEventListener("DOMContentLoaded", () => {
  if (!window.katex) return;
  for (const place of document.querySelectorAll(".math")) {
    for (const piece of [...place.childNodes]) {
      const found = piece.nodeType === Node.TEXT_NODE && piece.data.match(/^\s*\\([([])([^]*)\\[)\]]\s*$/);
      if (!found) continue;
      const set = document.createElement("span");
      katex.render(found[2], set, { displayMode: found[1] === "[", throwOnError: false });
      piece.replaceWith(set);
    }
  }
});
