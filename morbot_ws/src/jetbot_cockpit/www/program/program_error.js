// What went wrong, in a sentence for the person; place: the id of the block, or the number of the line.
export class ProgramError extends Error {
  constructor(sentence, /** @type {any} */ place = undefined) {
    super(sentence);
    this.place = place;
  }
}
