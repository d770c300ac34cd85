// What a screen reader says of a block and its fields, beside what Blockly lets it say.

const { Blockly } = globalThis;

// Returns a kind of field that is named by the input in which its block is: "x in power", not "number".
export const named = (Field) => class extends Field {
  getAriaTypeName() {
    const input = this.getSourceBlock()?.outputConnection?.targetConnection?.getParentInput();
    return input?.getAriaLabelText() ?? super.getAriaTypeName();
  }

  widgetCreate_() {
    const editor = super.widgetCreate_();
    editor.setAttribute("aria-label", this.getAriaTypeName());
    return editor;
  }
};

// Does this, once: each block is described by its tooltip, unless that is the one of the block around it, and a block
// that changes its place names its fields again; a list of choices is named as its field is; no command is
// "not selected"; no block of the toolbox owns what does not exist.
export function describeBlocks() {
  extend(Blockly.BlockSvg, "recomputeAriaContext", (block) => {
    for (const field of block.getFields()) if (field.EDITABLE) field.recomputeAriaContext();
    const [own, around] = [block, block.outputConnection?.targetBlock()].map(tooltipOf);
    block.getFocusableElement().setAttribute("aria-description", own === around ? "" : own);
  });
  extend(Blockly.FieldDropdown, "showEditor_", (field) => {
    field.menu_.getElement().setAttribute("aria-label", field.getAriaTypeName());
  });
  extend(Blockly.MenuItem, "createDom", (item) => {
    if (item.getElement().getAttribute("role") === "menuitem") item.getElement().removeAttribute("aria-selected");
  });
  extend(Blockly.Flyout, "show", async (flyout) => {
    await Blockly.renderManagement.finishQueuedRenders();
    for (const each of flyout.getWorkspace().getCanvas().querySelectorAll("[aria-owns]")) dropMissing(each);
  });
}

function tooltipOf(block) {
  return block ? Blockly.Tooltip.getTooltipOfObject(block) : null;
}

function dropMissing(owner) {
  const owned = owner.getAttribute("aria-owns").split(" ").filter((id) => document.getElementById(id));
  owner.setAttribute("aria-owns", owned.join(" "));
}

// Lets a method of Blockly's do this afterwards.
function extend({ prototype }, method, afterwards) {
  const { [method]: original } = prototype;
  prototype[method] = /** @this {any} */ function extended(...given) {
    const result = original.apply(this, given);
    afterwards(this);
    return result;
  };
}
