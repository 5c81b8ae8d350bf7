// Offers the other versions of the site, where it is published beside them (.ci/site_versions).
const here = document.documentElement.dataset.content_root || "./";

async function offer() {
  const site = new URL(here, location.href);
  const own = site.pathname.split("/").at(-2);
  const answer = await fetch(new URL("../versions.json", site));
  const known = answer.ok ? await answer.json() : [];
  const sidebar = document.querySelector(".sidebar-sticky");
  if (!sidebar || !known.includes(own) || known.length < 2) return;
  const label = document.createElement("label");
  label.className = "versions";
  label.append("Version ");
  const select = document.createElement("select");
  for (const version of known) select.append(new Option(version, version, false, version === own));
  select.addEventListener("change", async () => {
    const other = new URL(`../${select.value}/`, site);
    // The same page, if that version has it.
    const same = new URL(location.href.slice(site.href.length), other);
    const there = await fetch(same, { method: "HEAD" });
    location.assign(there.ok ? same : other);
  });
  label.append(select);
  sidebar.querySelector(".sidebar-brand")?.after(label);
}

// Pages that are read from a disk have no other versions.
if (location.protocol.startsWith("http")) offer();
