// What a program that fails becomes, so that a person sees why.

// Returns programs with a block fewer, or more of them, the smallest first. Blockly may refuse some.
export function smallerPrograms(program) {
  const smaller = [];
  const change = (slot, replacement) => {
    const before = slot.block;
    if (replacement) slot.block = replacement;
    else delete slot.block;
    smaller.push(JSON.stringify(program));
    slot.block = before;
  };
  for (const slot of slotsOf(program.blocks.blocks)) {
    const { inputs = {}, next } = slot.block;
    change(slot, next?.block);
    for (const { block } of Object.values(inputs)) if (block) change(slot, block);
  }
  const { blocks } = program.blocks;
  for (const gone of blocks.slice(1)) {
    program.blocks.blocks = blocks.filter((each) => each !== gone);
    smaller.push(JSON.stringify(program));
  }
  program.blocks.blocks = blocks;
  return smaller.sort((one, other) => one.length - other.length).map((each) => JSON.parse(each));
}

// Returns all inputs and places for a next block that have one.
function slotsOf(blocks) {
  const slots = blocks.flatMap(({ inputs = {}, next }) => [...Object.values(inputs), ...next ? [next] : []])
    .filter(({ block }) => block);
  return [...slots, ...slots.flatMap(({ block }) => slotsOf([block]))];
}
