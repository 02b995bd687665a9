// Texts of the page, in its language; values stand in braces.

const messages = JSON.parse(document.getElementById("page-messages").textContent);

/** The text of a key, with the names in braces replaced by values. */
function say(key, values = {}) {
  return messages[key].replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);
}
