// Numbers and axes in words.

export function axisText(axis) {
  return axis.unit ? `${axis.label} [${axis.unit}]` : axis.label;
}

/** Four significant digits, whole numbers as they are. */
export function numberText(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e6) return String(value).replace("-", "−");
  const text = value.toPrecision(4);
  return text.includes("e") ? text : String(Number(text)).replace("-", "−");
}

export function quantityText(value, axis) {
  return axis.unit ? `${numberText(value)} ${axis.unit}` : numberText(value);
}

/** An element with a class, text (never markup) and children. */
export function element(name, { className, text, ...properties } = {}, ...children) {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  Object.assign(made, properties);
  made.append(...children);
  return made;
}
