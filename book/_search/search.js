// The search page: finds as one types, in the index that the build has made (search_index.py).
// A number or a number's name leads to what bears it; words to headings, then to text, to numbers of
// the ledger by what they are, and to names of the code.
const TOKEN = /\d+\.[a-z]\b|\d+(?:\.\d+)*(?:e[+-]?\d+)?|[\p{L}\p{M}_][\p{L}\p{M}\p{N}_]*|[%°]/giu;
const SAME = { "π": "pi", equation: "eq", equations: "eq", eqs: "eq", figure: "fig", figures: "fig",
  tables: "table", tab: "table", "°": "deg", degrees: "deg" };
const NUMBER = /^\d/;
const MOST = 20; // results before the button that shows the others
const AROUND = 90; // letters before the first marked word of an excerpt

const stemmer = new Stemmer();
const lower = (text) => text.toLowerCase().normalize("NFC").replaceAll("’", "'");
const tokens = (text) => (lower(text).match(TOKEN) ?? []).map((word) => SAME[word] ?? word);
const stem = (word) => (/^[a-z]{3,}$/.test(word) ? stemmer.stemWord(word) : word);

// What a word is found by: itself, its stem, and the parts of a name of the code.
const known = new Map();
function forms(word) {
  if (!known.has(word)) {
    const parts = word.includes("_") ? word.split("_").filter(Boolean) : [];
    known.set(word, [...new Set([word, ...parts, stem(word), ...parts.map(stem)])]);
  }
  return known.get(word);
}

const OPTIONS = { fields: ["title", "label", "text", "inside"], tokenize: tokens, processTerm: forms,
  searchOptions: { tokenize: (word) => [word], processTerm: (word) => word,
    boost: { title: 4, label: 2, inside: 0.5 } } };
const book = new MiniSearch(OPTIONS), code = new MiniSearch(OPTIONS);

const entries = softgripSearch.documents.map(([kind, place, title, section, text, label, more], id) =>
  ({ id, kind, place, title, section, text, label, inside: "", ...more }));
// A section is found by its figures and tables too.
for (const { kind, section, text } of entries) if (kind === "exhibit") entries[section].inside += ` ${text}`;
book.addAll(entries);

// Three times as many as all else, and always last: they are read in once the page is there.
function readNames() {
  const found = softgripSearch.names.map(([sort, title, page, text], k) => ({
    id: entries.length + k, kind: "name", sort, title, text, label: "", section: -1,
    place: `api/${page}.html#${sort === "module" ? "module-" : ""}${title}` }));
  entries.push(...found);
  code.addAll(found);
}

// Each word as it is typed, or begun, or by its stem. In the second round a number may be begun too
// and a word be misspelt; in the last one, some of the words will do.
function look(words, round) {
  const queries = words.map((word) => {
    const number = NUMBER.test(word), fuzzy = round > 0 && !number && word.length > 4 ? 0.2 : false;
    const whole = { queries: [word], prefix: number ? round > 0 : word.length > 1, fuzzy };
    const stems = stem(word) === word ? [] : [{ queries: [stem(word)], fuzzy }];
    return { combineWith: "OR", queries: [whole, ...stems] };
  });
  const query = { combineWith: round < 2 ? "AND" : "OR", queries };
  return [...book.search(query), ...code.search(query)];
}

// What bears the number that is asked for comes first: an equation, an exhibit, a printed number.
// Then come headings that have all words, text, exhibits, numbers by what they are, and the reference.
const BEARS = { equation: 0, exhibit: 1, claim: 2 }, HEADING = 3;
const OTHERS = { section: 4, term: 4, equation: 5, exhibit: 5, claim: 6, name: 7 };

function rank(entry, words) {
  if (words.some((word) => NUMBER.test(word)) && entry.kind in BEARS) {
    const label = (entry.named ??= tokens(entry.label));
    if (words.every((word) => label.includes(word))) return BEARS[entry.kind];
  }
  return entry.kind === "section" && isTitle(entry, words) ? HEADING : OTHERS[entry.kind];
}

function isTitle(entry, words) {
  const title = (entry.heads ??= tokens(entry.title).flatMap(forms));
  return words.every((word) => title.some((head) => head.startsWith(word) || head === stem(word)));
}

// A decimal comma, where it can be no other: after a nought, or not before three digits.
const pointed = (query) => query.replace(/\b(0|\d+(?=,(?!\d{3}\b))),(?=\d)/g, "$1.");

function search(query) {
  const words = [...new Set(tokens(pointed(query)))], phrase = lower(query.trim());
  for (const round of words.length ? [0, 1, 2] : []) {
    const found = look(words, round);
    if (!found.length) continue;
    // Where some of the words will do, a number is what is asked for, and not its unit.
    const digits = words.filter((word) => NUMBER.test(word));
    const asked = round > 1 && digits.length ? digits : words;
    const results = found.map(({ id, score, terms }) => {
      const entry = entries[id], tier = rank(entry, asked);
      // The shorter label is the nearer to the number; words that stand together count twice.
      if (tier < HEADING) score = -entry.label.length;
      else if (words.length > 1 && lower(entry.text).includes(phrase)) score *= 2;
      return { entry, score, tier, terms: new Set(terms) };
    });
    // What a term means stands after the section that says most of it.
    const texts = results.filter(({ entry, tier }) => entry.kind === "section" && tier > HEADING);
    const most = Math.max(0, ...texts.map(({ score }) => score));
    for (const result of results) {
      if (result.entry.kind === "term" && isTitle(result.entry, words)) result.score = most * 0.999;
    }
    results.sort((a, b) => a.tier - b.tier || b.score - a.score || a.entry.id - b.entry.id);
    return { results, exact: round < 1 };
  }
  return { results: [], exact: true };
}

// The words of a text and where they stand, read once.
const texts = new Map();
function wordsOf(text) {
  if (!texts.has(text)) {
    texts.set(text, [...text.matchAll(TOKEN)].map(({ 0: word, index: start }) =>
      ({ start, end: start + word.length, forms: tokens(word).flatMap(forms) })));
  }
  return texts.get(text);
}

const hits = (text, terms) => wordsOf(text).filter((word) => word.forms.some((form) => terms.has(form)));

// A text, or a part of it, with the words marked that were found.
function marked(text, terms, from = 0, to = text.length) {
  const pieces = [];
  let at = from;
  for (const { start, end } of hits(text, terms)) {
    if (start < from || end > to) continue;
    pieces.push(text.slice(at, start), element("mark", "", text.slice(start, end)));
    at = end;
  }
  return [...pieces, text.slice(at, to)];
}

// A part of a text in which as many of the words as can be stand.
function excerpt(text, terms) {
  const found = hits(text, terms);
  let best = 0, most = 0;
  for (const { start } of found) {
    const near = found.filter((word) => word.start >= start && word.start < start + 2 * AROUND);
    const count = new Set(near.map((word) => word.forms.at(-1))).size;
    if (count > most) [best, most] = [start, count];
  }
  const cut = (at) => text.indexOf(" ", at) + 1 || text.length;
  const from = best > AROUND ? cut(best - AROUND) : 0;
  const to = text.length - from < 3 * AROUND ? text.length : cut(from + 3 * AROUND - 20);
  return [...(from ? ["… "] : []), ...marked(text, terms, from, to), ...(to < text.length ? ["…"] : [])];
}

function element(name, className, ...content) {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...content);
  return made;
}

function link(place, ...content) {
  const made = element("a", "", ...content);
  made.href = place;
  return made;
}

// Where a document is in the book, from the chapter down; the book's own name says nothing.
function way(section, own = []) {
  for (let at = section; at >= 0; at = entries[at].section) own.unshift(entries[at].title);
  return own.join(" › ");
}

function usual({ title, text, section }, terms) {
  return { title: marked(title, terms), where: way(section), text: excerpt(text, terms) };
}

const SHOWN = {
  term: usual,
  exhibit: usual,
  section: (entry, terms) => usual(
    hits(entry.text, terms).length ? entry : { ...entry, text: entry.text + entry.inside }, terms),
  equation(entry, terms) {
    const { text, ...shown } = usual(entry, terms), set = element("span", "equation");
    if (window.katex) katex.render(entry.tex, set, { throwOnError: false });
    return { ...shown, text: [set, " ", ...text] };
  },
  claim({ title, label, text, section, recomputed, outcome, stands = [] }, terms) {
    const verdict = element("span", `verdict ${outcome.split(" ").at(-1)}`, outcome);
    const came = recomputed ? `, recomputed ${recomputed}` : "";
    const places = stands.map((at) => link(entries[at].place, way(entries[at].section, [entries[at].title])));
    return {
      title: [...marked(label, terms), ": ", ...marked(title, terms)],
      where: `${way(section)} › ${text}`,
      text: [verdict, ` printed ${label}${came}`, ...places.flatMap((place, k) => [k ? "; " : " · stands in ", place])],
    };
  },
  name({ title, text, sort }, terms) {
    const name = element("code", "", ...marked(title, terms));
    return { title: [name], where: `Reference › ${sort}`, text: excerpt(text, terms) };
  },
};

function item({ entry, terms }) {
  const { title, where, text } = SHOWN[entry.kind](entry, terms);
  return element("li", entry.kind, element("p", "title", link(entry.place, ...title)),
    element("p", "where", where), element("p", "text", ...text));
}

document.addEventListener("DOMContentLoaded", () => {
  const form = document.querySelector("form.search"), field = form.elements.q;
  const list = document.querySelector("ol.results"), said = document.querySelector(".search-count");
  const hints = document.querySelector(".search-hints");

  function show() {
    const { results, exact } = search(field.value);
    list.replaceChildren(...results.slice(0, MOST).map(item));
    if (results.length > MOST) list.append(others(results));
    const count = results.length === 1 ? "1 result" : `${results.length} results`;
    const told = exact ? count : `Nothing matches this as it is typed; ${count} nearly.`;
    hints.hidden = field.value.trim() !== "";
    said.textContent = hints.hidden ? told : "";
  }

  function others(results) {
    const button = element("button", "", `Show the other ${results.length - MOST}`);
    button.type = "button";
    button.addEventListener("click", () => {
      const rest = results.slice(MOST).map(item);
      button.parentElement.replaceWith(...rest);
      rest[0].querySelector("a").focus();
    });
    return element("li", "others", button);
  }

  function address() {
    const state = new URLSearchParams(field.value.trim() ? { q: field.value.trim() } : {});
    history.replaceState(null, "", state.size ? `?${state}` : location.pathname);
  }

  function follow() {
    field.value = new URLSearchParams(location.search).get("q") ?? "";
    show();
  }

  // Arrow keys lead from the field through the results and back.
  document.querySelector(".search-page").addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const stops = [field, ...list.querySelectorAll("p.title a, button")];
    const here = document.activeElement, of = here.closest("li")?.querySelector("p.title a, button");
    const at = stops.indexOf(of ?? here);
    if (!step || at < 0 || !stops[at + step]) return;
    event.preventDefault();
    stops[at + step].focus();
  });
  field.addEventListener("input", () => { show(); address(); });
  form.addEventListener("submit", (event) => { event.preventDefault(); show(); address(); });
  addEventListener("popstate", follow);
  follow();
  field.focus();
  setTimeout(() => {
    readNames();
    show();
    list.ariaBusy = "false";
  });
});
