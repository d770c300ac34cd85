// What went wrong, in a sentence for the person; block: the id of where.
export class ProgramError extends Error {
  constructor(sentence, block) {
    super(sentence);
    this.block = block;
  }
}
