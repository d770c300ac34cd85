// A button that works while another finger holds the pad: browsers make no click of a second finger.

const CLICK_WITHIN = 1000; // ms after a touch: a click then belongs to that touch

// Calls action() once per press: as a finger touches if urgent() is true then, else as it lifts from the button.
// A click without a touch counts as well: the Enter key, assistive technology.
export function onPress(target, action, urgent = () => true) {
  const waiting = new Set(); // pointers whose action is due when they lift
  let touched = -Infinity;
  target.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    touched = event.timeStamp;
    if (urgent()) action();
    else waiting.add(event.pointerId);
  });
  target.addEventListener("pointerup", (event) => {
    touched = event.timeStamp;
    if (waiting.delete(event.pointerId) && isOver(target, event)) action();
  });
  target.addEventListener("pointercancel", (event) => waiting.delete(event.pointerId));
  target.addEventListener("click", (event) => {
    const ofTouch = event.detail > 0 && event.timeStamp - touched < CLICK_WITHIN;
    if (!ofTouch) action();
  });
}

// Returns whether the finger is on the button: it may have slid away.
function isOver(target, { clientX, clientY }) {
  return target.contains(document.elementFromPoint(clientX, clientY));
}
