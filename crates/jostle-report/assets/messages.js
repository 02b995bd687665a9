// Texts of the page, in its language; values stand in braces.

const messages = JSON.parse(document.getElementById("page-messages").textContent);

/** Units of the page: name, how many make up one SI unit, and fewest decimals. */
const units = JSON.parse(document.getElementById("page-units").textContent);

/** The unit that stands for an SI unit. */
const unitOf = (si) => units[si];

/** The text of a key, with the names in braces replaced by values. */
function say(key, values = {}) {
  return messages[key].replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);
}
