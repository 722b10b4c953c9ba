// Shows the card of a number, a term or an equation where the pointer or the keyboard is on a link
// to it, or a finger taps it. As a popover it is closed by a tap elsewhere and by the next.
document.addEventListener("DOMContentLoaded", () => {
  const cards = new Map();
  for (const card of document.querySelectorAll(".note-card")) {
    card.popover = "auto";
    cards.set(card.dataset.of, card);
    card.addEventListener("pointerenter", () => clearTimeout(soon));
    card.addEventListener("pointerleave", () => later(() => hide(card)));
    card.addEventListener("focusout", (e) => { if (!card.contains(e.relatedTarget)) hide(card); });
  }
  addEventListener("keydown", ({ key }) => { if (key === "Escape") cards.forEach(hide); });
  let soon;
  const later = (act, wait = 250) => { clearTimeout(soon); soon = setTimeout(act, wait); };
  const hide = (card) => { if (card.matches(":popover-open")) card.hidePopover(); };

  function show(mark, card) {
    clearTimeout(soon);
    // The card is then the next stop of the Tab key.
    if (!card.matches(":popover-open")) card.showPopover({ source: mark });
    const at = mark.getClientRects()[0], { clientWidth, clientHeight } = document.documentElement;
    const left = Math.max(8, Math.min(at.left, clientWidth - card.offsetWidth - 8));
    const above = at.bottom + card.offsetHeight > clientHeight && at.top > card.offsetHeight;
    card.style.left = `${left + scrollX}px`;
    card.style.top = `${(above ? at.top - card.offsetHeight : at.bottom) + scrollY}px`;
  }

  for (const mark of document.querySelectorAll("a.reference.internal")) {
    const card = cards.get(mark.getAttribute("href"));
    if (!card) continue;
    mark.setAttribute("aria-describedby", card.id);
    const isMouse = (event) => event.pointerType === "mouse";
    mark.addEventListener("pointerenter", (e) => { if (isMouse(e)) later(() => show(mark, card), 150); });
    mark.addEventListener("pointerleave", (e) => { if (isMouse(e)) later(() => hide(card)); });
    mark.addEventListener("focus", () => { if (mark.matches(":focus-visible")) show(mark, card); });
    mark.addEventListener("blur", (e) => { if (!card.contains(e.relatedTarget)) hide(card); });
    mark.addEventListener("click", (e) => {
      if (e.pointerType !== "touch") return;
      e.preventDefault(); // the link in the card leads on
      show(mark, card);
    });
  }
});
