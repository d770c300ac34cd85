// What went wrong, in a sentence for the person; block: the id of where.
export class ProgramError extends Error {
  constructor(sentence, /** @type {string | undefined} */ block = undefined) {
    super(sentence);
    this.block = block;
  }
}
