// How the site's search weighs what it has found. Pages that answer come before those that list: a page with hundreds
// of headings (all diagnostics, a reference) otherwise wins whatever is asked.
const PLACES = [
  [/^start\/questions/, 12],
  [/^(learn|use)\//, 10],
  [/^(start|rapid)\//, 5],
  [/^reference\/codes/, -40],
  [/^develop\//, -10],
];

var Scorer = {
  score: ([page, title, anchor, description, score, filename, kind]) => {
    if (kind === "index") return score + 100;
    const place = PLACES.find(([pattern]) => pattern.test(page));
    return score + (place ? place[1] : 0);
  },
  objNameMatch: 8,
  objPartialMatch: 4,
  objPrio: { 0: 5, 1: 0, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
