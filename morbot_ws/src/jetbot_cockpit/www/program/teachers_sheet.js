// The teacher's sheet: a pupil's page does not load it.

export class TeachersSheet {
  /** @type {any} */
  overview = null;
  news = {}; // of the class, by the time it is loaded

  // page: as Overview needs it
  constructor(page) {
    this.page = page;
  }

  async hello() {
    if (this.page.world.teacher) {
      const { Overview } = await import("./overview.js");
      this.overview ??= new Overview(this.page);
      this.overview.show(this.news);
    }
    this.overview?.hello();
  }

  show(news) {
    Object.assign(this.news, news);
    this.overview?.show(news);
  }
}
