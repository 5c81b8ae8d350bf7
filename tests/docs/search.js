// What the search of a built site finds: node search.js SITE < queries > pages, both JSON.
// The site's own scripts do it (searchtools.js, language_data.js, its index), without a browser.
const fs = require("fs");
const vm = require("vm");

const site = process.argv[2];
const queries = fs.readFileSync(0, "utf8");
const context = vm.createContext({
  location: { search: "" },
  URLSearchParams,
  document: {
    documentElement: { dataset: { content_root: "./" } },
    getElementById: () => ({ lastChild: null }),
  },
  SPHINX_HIGHLIGHT_ENABLED: false,
  _ready: () => {},
  _: (text) => text,
});
vm.runInContext("var window = globalThis;", context);
for (const name of ["_static/documentation_options.js", "_static/language_data.js", "_static/searchtools.js", "searchindex.js"])
  vm.runInContext(fs.readFileSync(`${site}/${name}`, "utf8"), context, name);
// What is to be shown first comes last.
const found = vm.runInContext(
  `${queries}.map((query) => Search._performSearch(...Search._parseQuery(query)).reverse())`,
  context,
);
console.log(JSON.stringify(found.map((results) => results.map(([page, title, anchor]) => [page, title, anchor]))));
