// Filters and sorts the rows of the ledger. What its form says, the address says too
// (`#chapter=4&outcome=open`), so that labels elsewhere, and readers, can link to it.
document.addEventListener("DOMContentLoaded", () => {
  const form = document.querySelector("form.ledger-filter");
  if (!form) return;
  const fields = form.elements, tables = [...document.querySelectorAll("table.ledger[data-chapter]")];
  const rows = tables.flatMap((table) => [...table.querySelectorAll("tr[id]")].map((row) => {
    const home = row.parentElement, cells = [...row.cells];
    cells[0].dataset.place = home.dataset.place; // is shown where a sorted row has left its place
    const words = [row.id, home.dataset.place, ...cells.map((cell) => cell.textContent)];
    return { row, home, table, text: words.join(" ").toLowerCase(),
      is: { ...table.dataset, ...home.dataset, ...row.dataset } };
  }));
  let linked; // the row that the address names: shown whatever the form says

  function filter() {
    const asked = [...form.querySelectorAll("select")].filter((select) => select.value);
    const words = fields.text.value.toLowerCase().split(/\s+/);
    let count = 0;
    for (const { row, is, text } of rows) {
      const found = asked.every((select) => is[select.name] === select.value) &&
        words.every((word) => text.includes(word));
      row.hidden = !found && row !== linked;
      count += found;
    }
    for (const table of tables) {
      for (const body of table.tBodies) body.hidden = !body.querySelector("tr[id]:not([hidden])");
      table.closest("section").hidden = !table.querySelector("tr[id]:not([hidden])");
    }
    fields.shown.value = `${count} of ${rows.length} numbers`;
  }

  // Numbers by their data, all else by its first words; what has none comes last either way.
  function key(cell) {
    if (cell.dataset.value) return Number(cell.dataset.value);
    return cell.className === "number" ? "" : (cell.firstChild?.textContent ?? "").trim().toLowerCase();
  }

  function sort() {
    const [, back, name] = fields.sort.value.match(/^(-?)(.*)$/);
    for (const table of tables) {
      const heads = [...table.tHead.rows[0].cells], column = heads.findIndex((head) => head.dataset.sort === name);
      for (const head of heads) head.ariaSort = head !== heads[column] ? "none" : back ? "descending" : "ascending";
      const own = rows.filter((each) => each.table === table);
      if (column < 0) {
        if (table.classList.contains("sorted")) for (const { row, home } of own) home.append(row);
        table.classList.remove("sorted");
        continue;
      }
      table.classList.add("sorted");
      const keyed = own.map(({ row }) => ({ row, by: key(row.cells[column]) }));
      keyed.sort(({ by: a }, { by: b }) => (a === "") - (b === "") || (back ? -1 : 1) * ((a > b) - (a < b)));
      table.sorted.append(...keyed.map(({ row }) => row));
    }
  }

  function fill(state) {
    for (const field of fields) if (field.name && field.type) {
      if (field.tagName !== "OUTPUT") field.value = state.get(field.name) ?? "";
      if (field.selectedIndex < 0) field.selectedIndex = 0; // no such choice
    }
    sort();
    filter();
  }

  function address() {
    const state = new URLSearchParams([...new FormData(form)].filter(([, value]) => value.trim()));
    history.replaceState(null, "", state.size ? `#${state}` : location.pathname + location.search);
  }

  // The address may name a row, a heading, or a state of the form.
  function follow() {
    const name = location.hash.slice(1), place = name ? document.getElementById(name) : null;
    const hidden = place?.closest("[hidden]");
    linked = place?.closest("tr");
    if (!place || (hidden && !linked)) fill(new URLSearchParams(place ? "" : name));
    else filter();
    if (hidden) place.scrollIntoView();
    else if (!place && name) form.scrollIntoView();
  }

  for (const table of tables) {
    table.sorted = table.createTBody();
    for (const head of table.tHead.rows[0].cells) {
      const button = document.createElement("button"), link = head.querySelector("a");
      button.type = "button";
      if (link) button.ariaLabel = `sort by ${head.textContent}`;
      else button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const name = head.dataset.sort, after = { [name]: `-${name}`, [`-${name}`]: "" };
        fields.sort.value = after[fields.sort.value] ?? name;
        sort();
        filter();
        address();
      });
    }
  }
  form.addEventListener("input", () => { linked = null; filter(); address(); });
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", (event) => {
    event.preventDefault();
    linked = null;
    fill(new URLSearchParams());
    address();
  });
  addEventListener("hashchange", follow);
  fill(new URLSearchParams());
  follow();
});
