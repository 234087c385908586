// Elements from values. All text goes in as text: nothing a deck or a log says becomes markup.

/** element("div.card", {title: "..."}, child, "text", ...) */
export function element(what, ...rest) {
  const [tag, ...classes] = what.split(".");
  const node = document.createElement(tag);
  if (classes.length) node.className = classes.join(" ");
  for (const part of rest.flat()) {
    if (part === null || part === undefined || part === false) continue;
    if (part instanceof Node) node.append(part);
    else if (typeof part === "object") set(node, part);
    else node.append(String(part));
  }
  return node;
}

function set(node, properties) {
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (name in node && name !== "list") node[name] = value;
    else node.setAttribute(name, value);
  }
}

export function section(id, title, note, ...children) {
  return element("section", { id }, element("header", element("h2", title), note && element("p.note", note)), ...children);
}

/** options: [value, text] pairs. */
export function select(label, options, value, onchange) {
  const box = element("select", { onchange: () => onchange(box.value) }, options.map(([v, text]) => element("option", { value: v, selected: String(v) === String(value) }, text)));
  return element("label.control", element("span", label), box);
}

export function slider(label, { min, max, step, value }, describe, oninput) {
  const out = element("output", describe(value));
  const input = element("input", { type: "range", min, max, step, "aria-label": label });
  input.value = value;
  input.addEventListener("input", () => {
    out.textContent = describe(Number(input.value));
    oninput(Number(input.value));
  });
  const control = element("label.control.slider", element("span", label), input, out);
  control.input = input;
  control.show = (v) => {
    input.value = v;
    out.textContent = describe(Number(v));
  };
  return control;
}
