// SPDX-License-Identifier: Apache-2.0
// The page of `crowdface edit`: one face, directed by hand.
import { getBinary, getJson, post, postForBinary, put } from '../api.js';
import { showKeys } from '../dialog.js';
import { el, short } from '../dom.js';
import { History } from '../history.js';
import { Beside } from './beside.js';
import { showElsewhere, showGenerate, showPutBack, showReplace } from './dialogs.js';
import { dressedFace, Exact, undressed } from './exact.js';
import { Expressions } from './expressions.js';
import { Library } from './library.js';
import { Measurements } from './measurements.js';
import { Newest } from './newest.js';
import { HeadHand } from './head_hand.js';
import { HeadView } from './head_view.js';
import { openPainting } from './painting.js';
import { Photo } from './photo.js';
import { photograph } from './photograph.js';
import { PlaneBoard } from './plane_board.js';
import { ProgramPage } from '../program_page.js';
import {
  bandNames, bandOf, coefficients, headAlone, headIndex, targetShares, weightsOf, wholeFace, wire, withBand,
} from './recipe.js';
import { readCrowd } from '../crowd.js';
import { Review } from '../review.js';
import { RegionPanel } from './region_panel.js';
import { Shelf } from './shelf.js';
import { toolbar, viewBar } from './toolbar.js';

const page = crypto.randomUUID(); // of several pages, the one that was opened last keeps its steps
const pages = new BroadcastChannel(`crowdface edit ${location.pathname}`);
const patient = 250; // ms that a draft waits for the program's face before it is drawn in full
const telling = 200; // ms between two answers about distances while something moves
const judging = 400; // ms that a face rests before its whole mesh is judged
const patience = 250; // ms that another page has to keep its last steps
const mostKept = 3e6; // letters of steps that the program keeps for us
const exaggerated = 0.5; // mm that strengths other than 1 add to a distance; from here on the page says so
const toldLater = 'crowdface told later';
const namePattern = /^[A-Za-z0-9_-][A-Za-z0-9_.-]{0,63}$/;

class Editor extends ProgramPage {
  constructor(job, mesh, state) {
    super();
    this.job = job;
    const { history, kept } = this.restored(state);
    const first = job.crowd?.faces[0]?.id;
    this.history = new History(this.here(first ? this.openedFace(first) : this.fromWire(job.start)), history);
    this.kept = kept;
    this.linked = new Set(state?.linked ?? []);
    this.locked = new Set(state?.locked ?? []);
    this.look = { show: 'surface', wireframe: false, wears: {}, expression: {}, ...state?.look };
    this.look.expression = Object.fromEntries(Object.entries(this.look.expression).filter(([name]) => job.shapes.includes(name)));
    const bands = bandNames(job);
    this.band = bands.find((band) => band === this.look.band) ?? bands[0]; // the one that panel and plane show
    this.look.wears = Object.fromEntries(Object.entries(this.look.wears)
      .filter(([kind, choice]) => choice === 'none' || job.attachments[kind]?.includes(choice)));
    this.before = null; // the id of the face that was open before
    if (job.crowd) {
      this.reviewedCrowd = readCrowd({
        ...job.crowd, name: job.name, seed: job.seed, heads: job.heads, near: [], likeness: [], regions: [],
      });
      // The browser's storage belongs to the port, which is another one tomorrow.
      this.review = new Review(this.reviewedCrowd, {
        getItem: () => this.look.review ?? null,
        setItem: (key, text) => { this.look.review = text; this.remember(); },
      });
    }
    this.passing = null; // a document that is shown while something is dragged
    this.isReleased = false; // whether a drag has ended since the last blend: its face is requested at once
    this.comparing = null; // which kept state is shown
    this.comparedWith = this.kept.length - 1;
    this.heads = [];
    this.exactOf = null;
    this.savedMeshes = new Set(); // that may be written again
    this.view = new HeadView(job, mesh);
    this.exact = new Exact({
      show: (face, document) => this.showExact(face, document),
      fail: (error) => {
        this.onItsWay = null;
        this.view.setMoving(this.passing !== null);
        this.say(error.message, true);
      },
      waiting: (waits) => this.status?.classList.toggle('waits', waits && !this.passing),
    });
    this.acting = new Newest({
      ask: async (document) => ({ document, face: await postForBinary('face', this.faceRequest(document)) }),
      show: ({ document, face }) => {
        if (!this.isActing || document !== this.document) return;
        this.view.setMoving(true);
        this.showExact(face, document);
      },
      fail: (error) => this.say(error.message, true),
    });
    this.measures = new Newest({
      ask: (asked) => post('measures', asked),
      show: async (measures) => {
        if (this.exactOf !== this.document) this.tell(measures);
        await new Promise((done) => { setTimeout(done, telling); }); // the processor draws meanwhile
      },
      fail: (error) => this.say(error.message, true),
    });
    this.faults = new Newest({
      ask: async (document) => ({ document, ...await post('faults', { recipe: wire(this.job, document) }) }),
      show: ({ document, faults }) => {
        this.faulty = { document, masksTurn: this.masksTurn, faults };
        if (this.exactOf === document) this.tell(this.told);
      },
      fail: (error) => this.say(error.message, true),
    });
    this.skin = new Newest({
      ask: (asked) => postForBinary('skin', asked),
      show: (skin) => this.view.setSkin(skin),
      fail: (error) => this.say(error.message, true),
    });
    this.build();
    this.photo = new Photo(this);
    this.shelf.node.append(this.photo.node);
    this.attempt(() => this.photo.restore());
    this.takeDrops();
    this.hand = new HeadHand(this);
    this.history.listeners.push(() => this.stepped());
    this.view.controls.addEventListener('end', () => this.remember());
    addEventListener('keydown', (event) => this.key(event));
    this.view.node.addEventListener('webglcontextlost', () =>
      this.say('The browser has lost the graphics card: load the page again, every step is kept.', true));
    addEventListener('pagehide', () => this.keepNow(true));
    new ResizeObserver(() => this.view.fit()).observe(this.stage);
  }

  /// The kept states whose heads exist. Their regions may differ from the config's.
  restored(state) {
    const known = (names) => Object.keys(names ?? {}).every((name) => headIndex(this.job, name) >= 0);
    const isKnown = ({ recipe, anchors }) => headIndex(this.job, recipe.target) >= 0 && known(anchors) && known(recipe.mixture) &&
      Object.values(recipe.regions).every((region) =>
        known(region.weights) && Object.values(region.bands ?? {}).every((band) => known(band.weights)));
    const documents = [];
    const again = (document) => {
      if (!this.hasConfigOf(document)) return document; // the config is put back before it is shown
      documents.push(document);
      return this.here(document);
    };
    const step = ({ document, label }) => ({ document: again(document), label });
    const { history } = state ?? {};
    const kept = (state?.kept ?? []).filter(({ document }) => isKnown(document))
      .map((entry) => ({ ...entry, document: this.here(entry.document) }));
    if (!history) return { kept: [] };
    const restored = { ...history, now: this.here(again(history.now)), past: history.past.map(step), future: history.future.map(step) };
    return documents.every(isKnown) && isKnown(restored.now) ? { history: restored, kept } : { kept: [] };
  }

  /// Converts a document to the config's regions: a region that the document lacks begins as a copy of another one.
  here(document) {
    const { recipe } = document;
    const any = Object.values(recipe.regions)[0];
    const regions = Object.fromEntries(this.job.regions.map(({ name }) => [name, recipe.regions[name] ?? any]));
    return { ...document, recipe: { ...recipe, regions }, config_regions: this.job.regions_edit, config_faces: this.job.faces_edit };
  }

  /// Whether a step was made with the regions and heads that the config has now. Steps of earlier versions do not say.
  hasConfigOf({ config_regions: regions, config_faces: faces }) {
    const isSame = (then, now) => then === undefined || now === undefined || then === now;
    return isSame(regions, this.job.regions_edit) && isSame(faces, this.job.faces_edit);
  }

  build() {
    this.stage = el('div', { class: 'stage' }, this.view.node);
    this.view.node.tabIndex = 0;
    this.view.node.setAttribute('role', 'img');
    this.view.node.setAttribute('aria-label', 'The face. Arrows turn it, Shift and arrows move it, + and − zoom in and out.');
    this.board = new PlaneBoard(this);
    this.panel = new RegionPanel(this);
    this.shelf = new Shelf(this);
    this.library = new Library(this);
    this.shelf.node.append(this.library.node);
    this.tools = toolbar(this);
    this.beside = new Beside(this);
    this.viewTools = viewBar(this);
    this.status = el('div', { class: 'measures', role: 'status', 'aria-live': 'polite' });
    this.measurements = new Measurements(this);
    this.expressions = new Expressions(this);
    this.frameNode = el('div', { class: 'frames', hidden: true });
    this.message = el('div', { class: 'message', role: 'alert', hidden: true });
    const skip = el('a', { class: 'skip', href: '#regions', onclick: (event) => {
      event.preventDefault();
      this.panel.firstSlider().focus();
    } }, 'To the sliders of the regions');
    this.node = el('div', { class: 'editor' }, skip, this.tools.node,
      el('main', {},
        el('section', { class: 'viewbox', 'aria-label': 'The face' }, this.stage, this.beside.stage, this.viewTools.node,
          this.frameNode, this.status, this.beside.bar),
        el('section', { class: 'middle', 'aria-label': 'The plane' }, this.board.node, this.shelf.node),
        el('aside', { 'aria-label': 'Regions' }, this.panel.node, this.expressions.node, this.measurements.node)),
      this.message);
  }

  /// The elements on which pictures of the library can be dropped, with the function that a drop calls.
  takeDrops() {
    const { library, board } = this;
    library.takesDrops(this.node.querySelector('.viewbox'), () => ({}));
    library.takesDrops(board.node, (event) => {
      const region = event.target.closest('.handle')?.dataset.region;
      return region ? { region } : { point: board.placeAt(event.clientX, event.clientY) };
    });
    for (const card of this.panel.node.querySelectorAll('.regioncard')) library.takesDrops(card, () => ({ region: card.dataset.region }));
  }

  // -- what is shown, and steps --

  /// The document that the page shows: {recipe, anchors, face}, never changed in place.
  get document() {
    if (this.comparing !== null) return this.kept[this.comparing].document;
    return this.passing ?? this.history.now;
  }

  /// Shows a document without making a step of the history.
  /// \param document  null: the document of the last step
  preview(document) {
    this.comparing = null;
    this.passing = document;
    this.refresh();
  }

  commit(document, label, options) {
    this.comparing = null;
    this.isReleased = this.passing !== null;
    this.passing = null;
    this.history.commit(this.here(document), label, options);
    this.refresh();
  }

  undo() { this.step('past', () => this.history.undo(), 'Nothing to undo.'); }
  redo() { this.step('future', () => this.history.redo(), 'Nothing to redo.'); }

  /// Goes one step back or forward. If the step was made with other regions or heads than the config's, the page first
  /// opens again with these.
  step(way, act, nothing) {
    this.comparing = null;
    this.passing = null;
    const next = this.history[way].at(-1);
    if (next && !this.hasConfigOf(next.document)) {
      const { config_faces: faces, config_regions: regions } = next.document;
      const areHeads = faces !== undefined && faces !== this.job.faces_edit;
      this.say(`Opening again with the other ${areHeads ? 'heads' : 'regions'} …`, false, true);
      this.attempt(() => this.openAgain(areHeads ? 'heads' : 'regions', { back: areHeads ? faces : regions }, act));
    } else if (!act()) {
      this.say(nothing);
    }
  }

  stepped() {
    this.refresh();
    this.remember();
  }

  /// Updates the page, at most once per frame.
  refresh() {
    if (this.pending || this.isLeaving) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = null;
      this.blendNow();
      this.board.show();
      this.panel.show();
      this.tools.show();
      this.viewTools.show();
      this.beside.refresh();
      if (this.shelfShows !== this.comparing) {
        this.shelfShows = this.comparing;
        this.shelf.show();
      }
    });
  }

  blendNow() {
    const { document, isReleased } = this;
    this.isReleased = false;
    this.askExact(document, isReleased);
    const shares = targetShares(this.job, document.recipe);
    const isMissing = shares.some((share, h) => share !== 0 && !this.heads[h]); // it comes with the head
    if (isMissing || (!this.ready && this.exactOf === document)) return;
    const key = shares.join();
    const isOther = key !== this.shares;
    if (isOther) {
      this.shares = key;
      this.view.blender.unsettle();
      this.showTexture();
    }
    this.view.setMoving(this.passing !== null || this.exactOf !== document);
    if (isReleased) this.view.hold();
    this.view.blend(...this.coefficientsOf(document), isOther && this.exactFaceOf === document ? this.exactFace : null);
  }

  /// Requests the program's face, unless the page shows it or has requested it.
  /// \param isReleased  whether a drag has just ended: the face and its textures are then requested at once
  askExact(document, isReleased) {
    const asked = JSON.stringify([this.look.wears, this.look.expression, this.masksTurn, this.ready]);
    if (this.exactOf === document) return;
    this.exactOf = null;
    if (this.onItsWay?.document === document && this.onItsWay.asked === asked) return;
    this.onItsWay = { document, asked };
    if (!this.view.draft) this.view.worn.node.visible = false;
    const request = this.faceRequest(document);
    if (this.passing) this.measures.ask({ recipe: request.recipe, face: document.face });
    this.exact.ask(document, { ...request, measure: Boolean(this.ready) }, isReleased);
    if (isReleased) this.askSkin(document);
    clearTimeout(this.holding);
    this.holding = setTimeout(() => this.view.setMoving(this.passing !== null), patient);
  }

  faceRequest(document) {
    const { wears, expression } = this.look;
    return { recipe: wire(this.job, document), face: document.face, wears, expression };
  }

  /// The coefficients that a blend takes: per region, and the weights of the target.
  coefficientsOf(document) {
    return [coefficients(this.job, document, this.heads), targetShares(this.job, document.recipe)];
  }

  showExact(face, document) {
    this.onItsWay = null;
    if (document !== this.document) return;
    this.exactOf = document;
    this.exactFace = face;
    this.exactFaceOf = document;
    if (!this.passing) this.view.hold();
    if (this.ready) this.view.blend(...this.coefficientsOf(document), face);
    else this.view.standAs(face);
    if (face.nearest_head) {
      this.tell(face);
      setTimeout(() => {
        if (!this.isLeaving && this.exactOf === document && !this.hasJudged(document)) this.faults.ask(document);
      }, judging);
    }
    this.attempt(() => this.showWorn(face));
    if (face.bare) {
      setTimeout(() => {
        if (this.exactFace !== face || this.exactOf !== document) return;
        this.exactOf = null;
        this.refresh();
      }, undressed);
    }
    this.askSkin(document);
  }

  /// Requests the textures of the document's face, unless the last request was the same.
  askSkin(document) {
    if (this.skinOf?.document === document && this.skinOf.masksTurn === this.masksTurn) return;
    this.skinOf = { document, masksTurn: this.masksTurn };
    this.skinShown = this.skin.ask({ recipe: wire(this.job, document) });
  }

  /// \return  parts and positions of each attachment of a face, for Worn.show
  attachmentsOf(face) {
    return Promise.all(face.worn.map(async (name) =>
      [await this.view.worn.prepare(name, () => getJson(`attachments/${name}`)), face[`worn ${name}`]]));
  }

  /// Shows the attachments at the positions that the program sent.
  async showWorn(face) {
    const all = await this.attachmentsOf(face);
    if (this.exactFace !== face || !this.exactOf) return;
    this.view.wear(all, face);
    this.view.worn.node.visible = !this.painting?.on;
    if (!this.view.moving || this.passing) {
      this.view.draw();
      return;
    }
    await this.skinShown; // the first picture in full has this face's skin
    if (this.exactFace === face && this.exactOf) this.view.setMoving(this.passing !== null);
  }

  /// \param shares    weights above zero, by names of expressions
  /// \param isMoving  whether a slider is still being dragged
  express(shares, isMoving) {
    this.look.expression = shares;
    this.isActing = isMoving;
    if (isMoving) {
      this.acting.ask(this.document);
      return;
    }
    this.exactOf = null;
    this.refresh();
    this.remember();
  }

  /// \param choice  draw, none or a name.
  wear(kind, choice) {
    this.look.wears = { ...this.look.wears, [kind]: choice };
    this.exactOf = null;
    this.refresh();
    this.remember();
  }

  /// Whether the page knows the faults of this face's whole mesh with the present masks.
  hasJudged(document) {
    return this.faulty?.document === document && this.faulty.masksTurn === this.masksTurn;
  }

  tell(face) {
    this.told = face;
    const warnings = face.warnings ?? [];
    const faults = this.hasJudged(this.document) ? this.faulty.faults.filter((text) => !warnings.includes(text)) : [];
    const warning = (title, texts) => (texts.length > 0 ? el('p', { class: 'warning' }, `${title} ${texts.join('; ')}.`) : null);
    const limits = this.job.limits ?? {};
    const distance = (title, near, name, limit) => (near ? el('span', { class: near.mm < limit ? 'bad' : null },
      `${title} `, el('b', {}, `${short(near.mm)} mm`), ` ${name}`,
      near.as_built_mm > near.mm + exaggerated ? ` (at strength 1; ${short(near.as_built_mm)} mm as shown)` : null) : null);
    const { asymmetry = 1, mirrored = false } = this.document.recipe;
    this.measurements.show(face.traits ?? []);
    this.status.replaceChildren(...[
      asymmetry === 1 ? null : el('span', { class: 'asymmetry' }, `asymmetry ${short(asymmetry)}`),
      mirrored ? el('span', { class: 'mirrored' }, 'mirrored') : null,
      distance('nearest head', face.nearest_head, face.nearest_head?.name, limits.head_mm),
      distance('nearest face', face.nearest_face, face.nearest_face?.id, limits.face_mm),
      face.ms === undefined ? null : el('span', { class: 'muted' }, `${Math.round(face.ms)} ms`),
      warning('generate would reject this face:', warnings),
      warning('the whole mesh has faults:', faults),
    ].filter(Boolean));
  }

  // -- regions --

  /// Smoothness and factors of a region in the band that is shown.
  numbersOf(name) {
    return bandOf(this.job, this.document.recipe, name, this.band);
  }

  showBand(band) {
    this.band = band;
    this.look.band = band;
    this.remember();
    this.refresh();
  }

  /// The document with these regions changed in the band that is shown: the named one, and those linked
  /// with it.
  /// \param change  (numbers, region) => other numbers; what it leaves alone stays each region's own.
  withRegions(name, change) {
    const { document } = this;
    const names = this.linked.has(name) ? [...this.linked] : [name];
    const regions = { ...document.recipe.regions };
    for (const other of names) {
      regions[other] = withBand(this.job, document.recipe, other, this.band, change(this.numbersOf(other), other));
    }
    return { ...document, recipe: { ...document.recipe, regions } };
  }

  toggleIn(set, name) {
    if (set.has(name)) set.delete(name);
    else set.add(name);
    this.refresh();
    this.remember();
  }

  isLinked(name) { return this.linked.has(name); }
  /// The name of a region in locks; it includes the band that is shown, if there are bands.
  partName(name, band = this.band) { return band ? `${name}/${band}` : name; }
  isLocked(name) { return this.locked.has(this.partName(name)); }
  toggleLink(name) { this.toggleIn(this.linked, name); }
  toggleLock(name) { this.toggleIn(this.locked, this.partName(name)); }
  /// [region, band] of all that is locked.
  lockedParts() {
    return this.job.regions.flatMap(({ name }) => bandNames(this.job).map((band) => [name, band]))
      .filter(([name, band]) => this.locked.has(this.partName(name, band)));
  }
  lockedNames() { return this.lockedParts().map(([name, band]) => this.partName(name, band)); }
  focusRegion(name) { this.panel.focus(name); }

  /// Shows or hides the time per frame.
  tellFrames() {
    const { view } = this;
    this.frameNode.hidden = !this.frameNode.hidden;
    view.onframe = this.frameNode.hidden ? null : (ms) => {
      this.frameNode.textContent = `${ms.toFixed(1)} ms a frame, ${view.node.width} × ${view.node.height} pixels`;
    };
    view.draw();
  }


  /// The heads with the largest weights, in percent.
  weightText(name) {
    return weightsOf(this.job, this.document, name, this.band)
      .map((weight, h) => [this.job.heads[h].name, Math.round(100 * weight)])
      .filter(([, percent]) => percent > 0).sort((a, b) => b[1] - a[1]).slice(0, 3)
      .map(([head, percent]) => `${head} ${percent} %`).join(', ');
  }

  setTarget(name) {
    const { document } = this;
    if (document.recipe.target === name && !document.recipe.mixture) return;
    const { mixture, ...recipe } = document.recipe;
    this.commit({ ...document, recipe: { ...recipe, target: name } }, `target ${name}`);
  }

  /// The position of a head on the plane.
  headPlace(name) {
    return this.document.anchors?.[name] ?? this.job.heads[headIndex(this.job, name)].anchor;
  }

  /// All controllers that are not locked go to a head.
  gather(name) {
    let { document } = this;
    const anchor = this.headPlace(name);
    const regions = { ...document.recipe.regions };
    for (const region of this.job.regions) {
      if (this.isLocked(region.name)) continue;
      const { weights, ...rest } = this.numbersOf(region.name);
      regions[region.name] = withBand(this.job, document.recipe, region.name, this.band,
        { ...rest, position: [...anchor] });
    }
    document = { ...document, recipe: { ...document.recipe, regions } };
    this.commit(document, `all on ${name}`);
  }

  // -- masks --

  offerPainting() {
    this.painting = openPainting(this);
    if (!this.painting) return;
    this.shelf.node.prepend(this.painting.node);
    this.viewTools.offerPainting();
    if (this.look.painting) this.painting.restore(this.look.painting);
  }

  masksChanged(alpha) {
    this.view.setMasks(alpha);
    this.beside.view?.setMasks(alpha);
    this.masksTurn = (this.masksTurn ?? 0) + 1;
    this.exactOf = null;
    this.refresh();
  }

  // -- documents --

  wire() {
    return wire(this.job, this.document);
  }

  /// Converts a recipe from the program to a document.
  fromWire(told, face = null) {
    const regions = Object.fromEntries(this.job.regions.map(({ name }) =>
      [name, { smoothness: 0.5, extrapolation: 1, ...told.regions[name] }]));
    for (const region of Object.values(regions)) if (region.iterations !== undefined) delete region.smoothness;
    return { recipe: { id: told.id, ...wholeFace(told), regions }, anchors: {}, ...(face ? { face } : {}) };
  }

  /// Converts a face of the crowd to a document. The copy's id is new.
  openedFace(name) {
    const face = this.job.crowd.faces.find((entry) => entry.id === name);
    return this.fromWire({ ...face, id: `${name}_edited` }, name);
  }

  open(what) {
    const [kind, name] = [what.slice(0, 4), what.slice(5)];
    if (kind === 'face') {
      const { face } = this.document;
      if (face && face !== name) this.before = face;
      this.commit(this.openedFace(name), `${name} opened`);
    } else if (kind === 'head') {
      this.commit(headAlone(this.job, name, this.document.recipe.id), `${name} opened`);
    }
  }

  /// A face of the crowd in the form that Review's functions take.
  reviewedFace(name) {
    return this.reviewedCrowd?.byId.get(name) ?? null;
  }

  /// Opens another face of the crowd.
  /// \param by  1: the next face, −1: the previous face
  walk(by) {
    const faces = this.job.crowd?.faces ?? [];
    if (faces.length === 0) return;
    const at = faces.findIndex((face) => face.id === this.document.face);
    this.open(`face ${faces[(at + by + faces.length) % faces.length].id}`);
  }

  rename(id) {
    if (!namePattern.test(id)) {
      this.say('A name has 1 to 64 letters, digits, _, - and ., and does not begin with a dot.', true);
      this.tools.show();
      return;
    }
    const { document } = this;
    this.commit({ ...document, recipe: { ...document.recipe, id } }, 'name');
  }

  pictureOf(document, dressed = null) {
    const { view } = this;
    const [lists, shares] = this.coefficientsOf(document);
    const other = shares.join() !== this.shares || Object.keys(this.look.expression).length > 0;
    if (other) view.blender.unsettle();
    const { shown, skin, node: { visible } } = view.worn;
    if (dressed) {
      view.worn.show(dressed);
      view.worn.setForm(view.software ? 'draft' : 'whole');
      view.worn.node.visible = true;
    } else if (document !== this.exactOf) view.worn.node.visible = false;
    view.blender.blend(lists, shares);
    const picture = view.picture();
    if (dressed) {
      view.worn.show(shown, skin);
      view.worn.setForm(view.moving ? 'draft' : 'whole');
    }
    view.worn.node.visible = visible;
    this.shares = null; // so that the page's face is blended again, or the program's placed again
    this.refresh();
    return picture;
  }

  /// A picture of a document's face with the attachments that the program gives it.
  async dressedPicture(document, wears = this.look.wears) {
    const face = await dressedFace({ recipe: wire(this.job, document), face: document.face, wears });
    return this.pictureOf(document, await this.attachmentsOf(face));
  }

  /// A picture of a face of the crowd.
  facePicture(name) { return this.dressedPicture(this.openedFace(name)); }

  /// A picture of the face with one more attachment.
  wornPicture(kind, name) { return this.dressedPicture(this.document, { ...this.look.wears, [kind]: name }); }

  /// Shows a kept state, or the face again.
  compare(index = this.comparing === null ? this.comparedWith : null) {
    if (index !== null && !this.kept[index]) {
      this.say('Keep a face first (K).');
      return;
    }
    this.passing = null;
    this.comparing = index === this.comparing ? null : index;
    if (this.comparing !== null) this.comparedWith = this.comparing;
    this.refresh();
  }

  // -- the view --

  setShow(show) {
    this.look.show = show;
    this.showTexture();
    this.beside.view?.setShow(this.beside.shown(show));
    this.viewTools.show();
    this.remember();
  }

  showTexture() {
    const { show } = this.look;
    if (!show.startsWith('texture')) {
      this.view.setShow(show);
      return;
    }
    const wanted = show === 'texture' ? headIndex(this.job, this.document.recipe.target) : Number(show.slice(8));
    if (this.job.heads[wanted]?.texture) this.attempt(() => this.view.setTexture(wanted));
    else this.view.setShow('surface');
  }

  cycleShow() {
    const { values } = this.viewTools;
    this.setShow(values[(values.indexOf(this.look.show) + 1) % values.length]);
  }

  setWireframe(on) {
    this.look.wireframe = on;
    this.view.setWireframe(on);
    this.viewTools.show();
    this.remember();
  }

  // -- the program --

  /// Saves the mesh. Asks once before it replaces a file.
  async saveMesh(format) {
    const { id } = this.document.recipe;
    const name = `${id}.${format}`;
    this.say('Saving …');
    try {
      const { file } = await post('save', { recipe: this.wire(), format, ask: !this.savedMeshes.has(name) });
      this.savedMeshes.add(name);
      this.say(`Saved: ${file}${Object.keys(this.look.expression).length > 0 ? ' (without the expression)' : ''}`);
    } catch (error) {
      if (error.status !== 409) throw error;
      this.say('');
      showReplace(name, () => this.attempt(() => {
        this.savedMeshes.add(name);
        return this.saveMesh(format);
      }));
    }
  }

  async savePicture() {
    const picture = photograph(this);
    const blob = await new Promise((done) => { picture.toBlob(done, 'image/png'); });
    const name = `${this.document.recipe.id}_view.png`;
    const link = el('a', { download: name, href: URL.createObjectURL(blob) });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    this.say(`Saved what the view shows: ${name}`);
  }

  putBack() { showPutBack(this); }
  generate() { showGenerate(this); }

  /// Sends history, kept states and view to the program, which stores them, after a short delay.
  remember() {
    clearTimeout(this.keeping);
    this.keeping = setTimeout(() => this.keepNow(false), 250);
  }

  /// Makes the program read config and crowd again; the page is then reloaded and keeps all steps.
  /// \param step  makes the step that this is, of the program's answer
  async openAgain(path, change, step = () => {}) {
    await this.keepNow(false);
    this.isLeaving = true; // from now on the program may have regions that this page does not know
    const answer = await post(path, change).catch((error) => {
      this.isLeaving = false;
      throw error;
    });
    step(answer);
    await this.keepNow(false);
    location.reload();
  }

  /// Shows a message after the page has been reloaded.
  tellLater(text) {
    try {
      sessionStorage.setItem(toldLater, text);
    } catch {
      // only a comfort
    }
  }

  tellNow() {
    const text = sessionStorage.getItem(toldLater);
    sessionStorage.removeItem(toldLater);
    if (text) this.say(text);
  }

  /// Called when another page has begun to edit: this page only shows the face and stores nothing.
  setAside() {
    if (this.isAside) return;
    this.isAside = true;
    showElsewhere();
  }

  async keepNow(leaving) {
    const { keeping, kept, look } = this;
    clearTimeout(keeping);
    if (this.isAside) return;
    const state = {
      page,
      history: this.history.toJson(mostKept), kept,
      look: { ...look, place: this.view.place(), painting: this.painting?.state() ?? look.painting },
      linked: [...this.linked], locked: [...this.locked],
    };
    try {
      await put('state', state, leaving);
    } catch (error) {
      if (error.status === 409) this.setAside();
      else if (!leaving) this.say(error.message, true);
    }
    if (this.keeping === keeping) this.keeping = null; // all steps are kept
  }

  // -- heads --

  /// Loads the program's face first, then the heads, which changes need: the target before the others.
  async load() {
    this.refresh();
    const shares = targetShares(this.job, this.document.recipe);
    const order = this.job.heads.map((_, h) => h).sort((a, b) => shares[b] - shares[a]);
    for (const h of order) {
      const head = await getBinary(`heads/${h}`);
      this.heads[h] = head;
      this.view.setHead(h, head);
      this.beside.view?.setHead(h, head);
      if (this.exactOf !== this.document) this.refresh();
    }
    const [{ name }] = this.job.regions;
    this.view.chooseBlend((strength) => this.coefficientsOf(
      this.withRegions(name, (region) => ({ ...region, extrapolation: strength }))),
    new URLSearchParams(location.search).get('blend'));
    this.shares = null;
    this.ready = true;
    this.exactOf = null; // now with what it wears and its measurements
    this.refresh();
    this.offerPainting();
    this.light = (await getBinary('light')).light;
    this.view.setLight(this.light);
    this.beside.view?.setLight(this.light);
    this.attempt(() => this.library.takePictures());
    if (typeof this.look.beside === 'string') this.beside.setOn(true);
  }

  // -- keys --

  help() {
    showKeys([['Tab', 'next control'], ['arrows', 'move the controller, head or slider that has the focus; with Shift finer; on the face: turn it'],
      ['Enter', 'on a head: make it the target'], ['1 2 3 …', 'the controller of that region'],
      ['Ctrl+Z, Ctrl+Shift+Z', 'undo, redo'], ['K, B', 'keep, compare with what was kept'],
      ['R, L, N', 'draw a face; six like this one; between two'], ['[ ]', 'faces of the crowd'],
      ['F, Q, P', 'front, three-quarter, profile'], [', . + −', 'turn, zoom in, zoom out'],
      ['W, C', 'wireframe; what the face shows'], ['S', 'another face beside'], ['I', 'time of a frame'],
      ...(this.painting ? [['M, Space', 'paint masks; paint in the middle of the view']] : []), ['Ctrl+S', 'save the mesh'], ['Esc', 'leave a field, close a list']]);
  }

  key(event) {
    if (document.querySelector('dialog[open]')) return;
    const letter = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      const held = {
        z: () => (event.shiftKey ? this.redo() : this.undo()), y: () => this.redo(),
        ...(this.painting?.on ? this.painting.heldKeys(event) : {}),
        s: () => this.attempt(() => this.saveMesh(this.tools.format.value)),
      }[letter];
      if (held && !event.target.matches('input[type=text], textarea')) {
        held();
        event.preventDefault();
      }
      return;
    }
    if (event.altKey) return;
    if (event.target.matches('input:not([type=range]), textarea, select')) {
      if (event.key === 'Escape') event.target.blur();
      return;
    }
    const region = this.job.regions[Number(event.key) - 1];
    const act = region ? () => this.board.focusHandle(region.name) : this.actOf(event, letter);
    if (!act) return;
    this.attempt(act);
    event.preventDefault();
  }

  actOf(event, letter) {
    const { view } = this;
    if (event.target === view.node && event.key.startsWith('Arrow')) return () => view.arrow(event.key, event.shiftKey);
    return {
      k: () => this.shelf.keep(), b: () => this.compare(), r: () => this.shelf.draw(), l: () => this.shelf.offer(),
      n: () => this.shelf.startTravel(), '[': () => this.walk(-1), ']': () => this.walk(1),
      f: () => view.view('front'), q: () => view.view('three_quarter'), p: () => view.view('profile'),
      ',': () => view.turn(-10), '.': () => view.turn(10), '+': () => view.nearer(0.85), '=': () => view.nearer(0.85),
      '-': () => view.nearer(1 / 0.85), i: () => this.tellFrames(), w: () => this.setWireframe(!this.look.wireframe), c: () => this.cycleShow(), s: () => this.beside.setOn(!this.beside.on),
      '?': () => this.help(), escape: () => this.closeAll(),
      ...(this.painting ? { m: () => this.painting.setOn(!this.painting.on) } : {}),
      ...(this.painting?.on && event.target === view.node ? { ' ': () => this.painting.paintMiddle() } : {}),
    }[letter];
  }

  closeAll() {
    this.hand.select(null);
    if (this.photo.matching) this.photo.setMatching(false);
    this.shelf.closePicks();
    if (this.painting?.on) this.painting.setOn(false);
    if (!this.shelf.path.hidden) this.shelf.endTravel(false);
    if (this.comparing !== null) this.compare(null);
  }
}

/// Makes this page the one that edits. Another page of this browser stores its last steps first.
/// \return the stored state
async function takeOver() {
  await new Promise((done) => {
    pages.onmessage = ({ data }) => { if (data === 'kept') done(); };
    pages.postMessage('opened');
    setTimeout(done, patience);
  });
  const state = await post('state', { page });
  pages.onmessage = async ({ data }) => {
    const { editor } = window.crowdface ?? {};
    if (data !== 'opened' || !editor) return;
    await editor.keepNow(false);
    pages.postMessage('kept');
    editor.setAside();
  };
  return state;
}

async function start() {
  const place = document.getElementById('page');
  try {
    const [job, mesh, state] = await Promise.all([getJson('job'), getBinary('mesh'), takeOver().catch(() => null)]);
    document.title = `${job.name} · crowdface edit`;
    const editor = new Editor(job, mesh, state);
    window.crowdface = { editor };
    place.replaceWith(editor.node);
    editor.view.fit();
    editor.view.restore(editor.look.place);
    editor.view.setWireframe(editor.look.wireframe);
    editor.showTexture();
    editor.refresh();
    await editor.attempt(() => editor.load());
    await editor.attempt(() => editor.tellNow());
  } catch (error) {
    place.replaceChildren(el('p', { class: 'waiting' }, error.message));
  }
}

start();
