// Short forms for the elements of the page. Text from outside reaches it through setText alone.

export function element(id) {
  return document.getElementById(id);
}

export function setText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

export function setClass(target, name, on) {
  target.classList.toggle(name, Boolean(on));
}

// Returns a new element with this class and text.
export function create(tag, className = "", text = "") {
  const made = document.createElement(tag);
  made.className = className;
  made.textContent = text;
  return made;
}

// Returns a new button; action(): it was pressed, or null.
export function button(text, action, className = "") {
  const made = create("button", className, text);
  made.type = "button";
  if (action) made.addEventListener("click", action);
  return made;
}

// Whether keys typed now are meant as text.
export function isTextField(target) {
  return target instanceof HTMLInputElement && target.type !== "range";
}
