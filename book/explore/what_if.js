// The claims of the ledger as a page judges them: the rule of book/companion/printed.py and
// verdict.py, with what book/explore/claim_laws.py wrote, and how the page shows what moved.
var softgripWhatIf = (it) => {
  // The value, and the least and largest that rounding allows: `carried` of printed.py.
  function carried(law, x, half) {
    const out = [0], count = half.filter((h) => h).length;
    const at = (moves) => {
      let k = 0;
      law([x.map((v, i) => (half[i] ? v + moves[k++] * half[i] : v))], [out]);
      return out[0];
    };
    const value = at(Array(count).fill(0)), found = [];
    if (count > it.corners) {
      const up = [];
      for (let k = 0; k < count; k++) {
        const [low, high] = [-1, 1].map((sign) => at(Array.from({ length: count }, (_, i) => (i === k ? sign : 0))));
        found.push(low, high);
        up.push(high >= low ? 1 : -1);
      }
      found.push(at(up), at(up.map((sign) => -sign)));
    } else if (count) {
      for (let c = 0; c < 1 << count; c++) found.push(at(Array.from({ length: count }, (_, k) => ((c >> k) & 1 ? 1 : -1))));
    }
    return { value, low: found.reduce((a, b) => (b < a ? b : a), value), high: found.reduce((a, b) => (b > a ? b : a), value) };
  }

  // `meets` of verdict.py: null if some of the values do, and some not.
  function meets(relation, number, half, low, high) {
    if (relation === "=" || relation === "~") {
      const slack = half + 1e-9 * Math.max(Math.abs(number), half);
      return low <= number + slack && high >= number - slack;
    }
    const [first, last] = [low, high].map((v) => (relation === "<" ? v < number : v > number));
    return first === last ? first : null;
  }

  // A claim, with the inputs that are another's than stated as numbers, the others undefined.
  function judge(claim, given) {
    const changed = (k) => k >= 0 && given[k] !== undefined;
    const x = claim.x.map((v, i) => (changed(claim.from[i]) ? given[claim.from[i]] : v));
    const half = claim.half.map((h, i) => (changed(claim.from[i]) ? 0 : h));
    const held = changed(claim.held), number = held ? given[claim.held] : claim.number;
    const spread = carried(it.laws[claim.law], x, half);
    const outcome = () => {
      if (claim.settled) return claim.settled;
      const holds = meets(claim.relation, number, held ? 0 : claim.half_unit, spread.low, spread.high);
      if (holds !== false) return holds ? "reproduced" : "open";
      if (claim.mayBeClose && !held && Math.abs(spread.value - number) <= it.close * Math.abs(number)) return "close";
      return claim.undecided || claim.about.some((k) => !changed(k)) ? "open" : "contradicts";
    };
    return { outcome: outcome(), ...spread };
  }
  const stated = it.claims.map((claim) => judge(claim, []));

  // What hangs on the changed inputs: a claim that prints one of them is not judged.
  function changes(given) {
    const hangs = (claim) => claim.by.some((k) => given[k] !== undefined) && given[claim.prints] === undefined;
    const found = it.claims.flatMap((claim, i) => (hangs(claim) ? [{ claim, before: stated[i], now: judge(claim, given) }] : []));
    const other = ({ before, now }) => before.value !== now.value || before.low !== now.low || before.high !== now.high;
    return {
      moved: found.filter((c) => c.before.outcome !== c.now.outcome),
      shifted: found.filter((c) => c.before.outcome === c.now.outcome && other(c)),
      still: found.filter((c) => c.before.outcome === c.now.outcome && !other(c)),
      left: it.left.filter(hangs),
    };
  }

  const made = (name, ...inner) => {
    const [tag, kind] = name.split("."), one = document.createElement(tag);
    if (kind) one.className = kind;
    one.append(...inner);
    return one;
  };
  const link = (id, text) => Object.assign(made("a", text), { href: `ledger.html#claim-${id}` });
  const digits = (v) => String(+v.toPrecision(4)).replace("-", "\u2212");
  const range = ({ low, high }) => (digits(low) === digits(high) ? digits(low) : `${digits(low)} to ${digits(high)}`);
  const chip = (outcome) => Object.assign(made("span", `${it.marks[outcome]} ${outcome}`), { className: `verdict ${outcome}` });

  function row({ claim, before, now }) {
    const verdict = made("td", chip(before.outcome));
    if (now.outcome !== before.outcome) verdict.append(" \u2192 ", chip(now.outcome));
    const cells = Object.entries({ printed: claim.printed, before: range(before), now: range(now) }).map(([name, text]) => {
      const cell = made("td.number", text);
      cell.dataset.name = name; // where the table has no columns
      return cell;
    });
    return made("tr", made("td", link(claim.id, claim.what), made("small", ` ${claim.where}`)), ...cells, verdict);
  }
  function table(rows) {
    const head = made("tr", ...["what", "printed", "before", "now", "verdict"].map((text) => Object.assign(made("th", text), { scope: "col" })));
    return made("table.ledger", made("thead", head), made("tbody", ...rows.map(row)));
  }
  const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;

  function show(root, now) {
    const given = now.map((value, k) => (value === it.sliders[k].begin ? undefined : value));
    const { moved, shifted, still, left } = changes(given);
    const part = (name) => root.querySelector(`.${name}`);
    it.sliders.forEach((s, k) => root.querySelector(`[name="${s.name}"]`).parentElement.classList.toggle("changed", given[k] !== undefined));
    part("told").textContent = given.some((value) => value !== undefined)
      ? `${counted(moved.length, "verdict")} moved; ${counted(shifted.length, "more number")} changed.`
      : "All inputs are as stated.";
    part("counts").replaceChildren(...Object.entries(it.counts).map(([outcome, count]) => {
      const come = moved.filter((c) => c.now.outcome === outcome).length - moved.filter((c) => c.before.outcome === outcome).length;
      const one = chip(outcome);
      one.textContent = `${it.marks[outcome]} ${count}${come ? ` \u2192 ${count + come}` : ""} ${outcome}`;
      return made("li", one);
    }));
    part("moved").replaceChildren(...(moved.length ? [table(moved)] : []));
    const rest = [...shifted, ...still];
    part("rest").replaceChildren(...[...new Set(rest.map((c) => c.claim.chapter))].map((chapter) => {
      const own = rest.filter((c) => c.claim.chapter === chapter);
      return made("details", made("summary", `Chapter ${chapter}: ${counted(own.length, "claim")} whose verdict stands`), table(own));
    }));
    part("left").replaceChildren(...(left.length
      ? [made("details", made("summary", `${counted(left.length, "claim")} that only the call computes`),
          made("ul", ...left.map((claim) => made("li", link(claim.id, claim.what)))))] : []));
  }
  return Object.assign(it, { judge, changes, show });
};
