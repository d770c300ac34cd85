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

// Lets each block be described by its tooltip, once, but no number that is part of another one; a block that changes
// its place names its fields again.
export function describeBlocks() {
  const block = Blockly.BlockSvg.prototype;
  const { recomputeAriaContext } = block;
  block.recomputeAriaContext = /** @this {any} */ function describe() {
    recomputeAriaContext.call(this);
    for (const field of this.getFields()) if (field.EDITABLE) field.recomputeAriaContext();
    const tooltip = this.isShadow() ? "" : Blockly.Tooltip.getTooltipOfObject(this);
    this.getFocusableElement().setAttribute("aria-description", tooltip);
  };
}
