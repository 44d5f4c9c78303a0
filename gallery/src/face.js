// SPDX-License-Identifier: Apache-2.0
import { changeButtons, shortName } from './changes.js';
import { el, short } from './dom.js';
import { bandsOf, isLoaded, loadFace, locksAll, relativesOf } from './crowd.js';
import { picture } from './grid.js';
import { linkViews } from './linked_views.js';
import { headsMean, traitText, wordsOf } from './traits.js';
import { Turntable } from './turntable.js';

const viewNames = { front: 'Front', three_quarter: 'Three-quarter', profile: 'Profile', back: 'Back' };

/// "ann 70 %, bob 30 %"
const sharesOf = (mixture) => Object.entries(mixture).sort((a, b) => b[1] - a[1])
  .map(([head, share]) => `${head} ${short(100 * share, 0)} %`).join(', ');

/// The page of one face: a 3D view, marks, recipe, neighbours and renders.
export class FacePage {
  /// \param go  called with the face to show next, or null to close the page
  constructor(crowd, review, go) {
    Object.assign(this, { crowd, review, go });
    this.stage = el('div', { class: 'stage' });
    this.otherStage = el('div', { class: 'stage other' });
    this.otherName = el('p', { class: 'othername', hidden: true });
    this.status = el('p', { class: 'status', hidden: true });
    this.choices = el('div', { class: 'choices' });
    this.side = el('div', { class: 'side' });
    this.title = el('h1', {});
    this.place = el('span', { class: 'muted' });
    this.node = el('main', { class: 'face' },
      el('header', {},
        el('button', { onclick: () => go(null), title: 'Back to all faces (Esc)' }, '← All faces'),
        this.title, this.place, el('span', { class: 'grow' }),
        el('button', { onclick: () => this.step(-1), title: 'Previous (←)', 'aria-label': 'Previous' }, '‹'),
        el('button', { onclick: () => this.step(1), title: 'Next (→)', 'aria-label': 'Next' }, '›')),
      el('div', { class: 'columns' },
        el('section', { class: 'left' }, this.box = el('div', { class: 'box' }, this.stage, this.otherStage, this.otherName, this.status),
          this.choices, this.rendersBox = el('div', { class: 'renders' })),
        this.side));
    this.faces = [];
  }

  step(by) {
    const at = this.faces.indexOf(this.face);
    const next = this.faces[at + by];
    if (next) this.go(next);
  }

  /// \param faces  the faces that the arrow keys step through
  async show(face, faces) {
    if (this.face && this.face !== face) this.before = this.face;
    this.face = face;
    this.faces = faces;
    if (!isLoaded(face)) {
      try {
        await loadFace(this.crowd, face);
      } catch (error) {
        if (this.face === face) this.say(`Its data cannot be read: ${error.message}.`);
        return;
      }
      if (this.face !== face) return;
    }
    this.title.textContent = face.id;
    const at = faces.indexOf(face);
    this.place.textContent = at >= 0 ? `${at + 1} of ${faces.length}` : '';
    this.rendersBox.replaceChildren(...(face.picture
      ? [el('img', { src: face.picture, alt: `Renders of ${face.id}` })] : []));
    this.side.replaceChildren(...[this.marks(), this.about(), this.expressions(), this.family(), this.traits(),
      this.recipe(), this.neighbours()].filter(Boolean));
    this.compare(this.isDouble ? this.compared : 'face');
  }

  // -- 3D view --

  table(name = 'turntable', stage = this.stage) {
    if (this[name]) return this[name];
    try {
      this[name] = new Turntable();
    } catch {
      this.say('This browser shows no 3D (WebGL is off).');
      return null;
    }
    stage.replaceChildren(this[name].node);
    new ResizeObserver(() => this[name].fit()).observe(stage);
    if (stage === this.otherStage) linkViews([this.turntable, this[name]]);
    return this[name];
  }

  say(text) {
    this.status.hidden = !text;
    this.status.textContent = text ?? '';
  }

  /// The subjects that the face can be compared with: [folder, file, name, label of the button].
  subjects() {
    const { face, crowd } = this;
    const of = (other, word) => [`data/faces/${other.folder}`, other.id, other.id, `${word}${other.id}`];
    const near = crowd.byId.get(face.near[0]?.id);
    const before = this.before !== face && this.before !== near ? this.before : null;
    return {
      face: of(face, ''),
      target: ['data/heads/', face.target, `head ${face.target}`,
        `${face.mixture ? 'largest part of its target' : 'target'} ${face.target}`],
      ...(near ? { near: of(near, 'nearest ') } : {}),
      ...(before ? { before: of(before, 'before ') } : {}),
    };
  }

  /// Shows the face or another subject with the same camera; if there are two views, the other subject beside the face.
  async compare(what) {
    const { face } = this;
    this.compared = this.isDouble && what === 'face' ? 'target' : what;
    if (!this.subjects()[this.compared]) this.compared = this.isDouble ? 'target' : 'face';
    this.drawChoices();
    this.box.classList.toggle('two', Boolean(this.isDouble));
    this.otherName.hidden = !this.isDouble;
    await this.showIn(this.table(), this.isDouble ? 'face' : this.compared);
    if (!this.isDouble || this.face !== face) return;
    this.otherName.textContent = this.subjects()[this.compared][2];
    const other = this.table('otherTable', this.otherStage);
    await this.showIn(other, this.compared);
    other?.lookAs(this.turntable);
    other?.act(this.values);
  }

  async showIn(table, what) {
    if (!table) return;
    const { face } = this;
    const [folder, file, name] = this.subjects()[what];
    table.fit();
    try {
      await table.show(`${folder}${file}.js`, name);
      if (this.face === face) this.say(null);
    } catch (error) {
      if (this.face === face) this.say(`Its mesh cannot be shown: ${error.message}.`);
    }
  }

  setDouble(on) {
    this.isDouble = on;
    this.compare(on ? this.compared : 'face');
  }

  drawChoices() {
    const subjects = Object.entries(this.subjects()).filter(([what]) => !this.isDouble || what !== 'face');
    this.choices.replaceChildren(
      el('button', {
        class: this.isDouble ? 'on' : '', 'aria-pressed': String(Boolean(this.isDouble)),
        title: 'The face and another one, seen by the same camera (S)', onclick: () => this.setDouble(!this.isDouble),
      }, 'Side by side'),
      el('div', { class: 'group', role: 'group', 'aria-label': this.isDouble ? 'Beside the face' : 'What is shown' },
        subjects.map(([what, [, , , text]]) => el('button', {
          class: this.compared === what ? 'on' : '', 'aria-pressed': String(this.compared === what),
          title: this.isDouble ? `${text} beside the face` : `Show ${text}`, onclick: () => this.compare(what),
        }, text))),
      el('span', { class: 'grow' }),
      el('div', { class: 'group', role: 'group', 'aria-label': 'Standard views' }, Object.entries(viewNames).map(([view, text]) =>
        el('button', { title: `${text} view`, onclick: () => this.turntable?.view(view) }, text))));
  }

  // -- marks --

  marks() {
    const { face, review } = this;
    const box = el('section', { class: 'marks' });
    const draw = () => {
      const mark = review.of(face);
      const button = (verdict, text, key) => el('button', {
        class: `${verdict} ${mark?.verdict === verdict ? 'on' : ''}`, title: `${text} (${key})`,
        disabled: verdict === 'reject' && face.byHand,
        onclick: () => review.verdict(face, verdict),
      }, text);
      const locked = mark?.lock ?? [];
      const locks = this.crowd.locks.length > 0 && !face.byHand
        ? el('div', { class: 'locks' }, el('span', { class: 'muted' }, 'Redraw, but lock'),
          this.crowd.locks.map((part, at) => el('button', {
            class: `lock ${locked.includes(part) ? 'on' : ''}`, title: `Lock ${part} (${at + 1})`,
            disabled: !locked.includes(part) && locksAll(this.crowd, new Set([...locked, part])),
            onclick: () => review.lock(face, part),
          }, part)))
        : null;
      const changes = changeButtons({
        crowd: this.crowd, face, before: this.before, change: mark?.change ?? {},
        ask: (name, value) => review.ask(face, name, value),
      });
      verdicts.replaceChildren(
        el('div', { class: 'verdicts' }, button('keep', 'Keep', 'K'), button('reject', 'Reject', 'R')),
        ...(locks ? [locks] : []), ...(changes ? [changes] : []),
        ...(face.byHand ? [el('small', { class: 'muted' },
          'It is written by hand or has children: change the config instead of rejecting it.')] : []));
    };
    const verdicts = el('div', {});
    const note = el('textarea', {
      class: 'note', rows: '2', maxlength: '500', placeholder: 'Note (N)', 'aria-label': 'Note', title: 'A note about this face (N)',
      value: review.of(face)?.note ?? '',
      oninput: () => review.change(face, { note: note.value.trim() }),
      onkeydown: (event) => {
        event.stopPropagation();
        if (event.key === 'Escape') note.blur();
      },
    });
    this.redrawMarks = draw;
    draw();
    box.append(verdicts, note);
    return box;
  }

  showMark(face) {
    if (face === this.face) this.redrawMarks?.();
  }

  // -- facts about the face --

  /// A slider for each expression shape. The values are kept from face to face, for comparison.
  expressions() {
    const { shapes } = this.crowd;
    if (shapes.length === 0) return null;
    this.values ??= shapes.map(() => 0);
    const act = () => {
      for (const table of [this.turntable, this.isDouble && this.otherTable].filter(Boolean)) {
        table.setMoving(true);
        table.act(this.values);
        table.setMoving(false);
      }
    };
    const sliders = shapes.map((name, s) => el('input', {
      type: 'range', min: 0, max: 1, step: 0.01, value: this.values[s], 'aria-label': name,
      oninput: (event) => {
        this.values[s] = Number(event.target.value);
        act();
      },
    }));
    const rest = () => {
      this.values.fill(0);
      for (const slider of sliders) slider.value = 0;
      act();
    };
    return el('section', { class: 'expressions' },
      el('header', {}, el('h2', {}, 'Expressions'), el('span', { class: 'grow' }), el('button', { title: 'All expressions to zero', onclick: rest }, 'At rest')),
      shapes.map((name, s) => el('label', {}, el('span', {}, name), sliders[s])));
  }

  about() {
    const { face } = this;
    const rows = [
      ['Target', face.mixture ? sharesOf(face.mixture) : face.target],
      face.colours ? ['Colours', sharesOf(face.colours)] : null,
      face.tags.length > 0 ? ['Tags', face.tags.join(', ')] : null,
      face.attachments?.length > 0 ? ['Wears', face.attachments.join(', ')] : null,
      face.group ? ['Group', face.group] : null,
      face.family ? ['Family', face.family] : null,
      face.age_years ? ['Age', `${short(face.age_years)} years`]
        : face.age ? ['Age', short(face.age)] : null,
      face.asymmetry === undefined ? null : ['Asymmetry', short(face.asymmetry)],
      face.mirrored ? ['Mirrored', 'yes'] : null,
      face.nearest ? ['Nearest head', `${face.nearest.face}, ${short(face.nearest.face_mm)} mm`] : null,
      face.attempt > 0 ? ['Candidates rejected before it', String(face.attempt)] : null,
      face.changed ? ['Changed', face.changed.join('; ')] : null,
      face.note ? ['Earlier note', face.note] : null,
    ].filter(Boolean);
    return el('section', {}, el('dl', {}, rows.map(([name, value]) =>
      [el('dt', {}, name), el('dd', {}, value)])));
  }

  /// The measurements, and their differences from the mean of the heads.
  traits() {
    const { face, crowd } = this;
    if (!face.traits) return null;
    return el('section', {}, el('h2', {}, 'Measurements'), el('dl', {}, crowd.traits.map((trait) => {
      const value = face.traits[trait.name];
      const difference = value - headsMean(crowd, trait.name);
      return [el('dt', {}, wordsOf(trait.name)), el('dd', {}, traitText(trait, value),
        el('small', { class: 'muted' }, ` ${difference < 0 ? '−' : '+'}${short(Math.abs(difference), trait.unit ? 1 : 3)}`))];
    })));
  }

  /// The family as a tree: parents; the face and its siblings; children.
  family() {
    const { parents, siblings, children } = relativesOf(this.crowd, this.face);
    if (parents.length + siblings.length + children.length === 0) return null;
    const cell = (name, face, text, head) => el('button', {
      class: 'neighbour', disabled: !face, title: face ? `Open ${name}` : name, onclick: () => this.go(face),
    }, picture(face ?? head, name), el('b', {}, shortName(this.crowd, name)), el('span', {}, text));
    const share = this.face.mother_share;
    const gave = ({ role }) => {
      const parts = Object.entries(this.face.inherits ?? {}).flatMap(([region, from]) => (typeof from === 'string'
        ? [[region, from]] : Object.entries(from).map(([band, parent]) => [`${region} ${band}`, parent])))
        .filter(([, from]) => from === role).map(([part]) => part);
      if (share) parts.unshift(`large forms ${short(100 * (role === 'mother' ? share : 1 - share), 0)} %`);
      return `${role}: ${parts.join(', ')}`;
    };
    const row = (title, cells) => (cells.length > 0
      ? [el('h3', {}, title), el('div', { class: 'neighbours' }, cells)] : []);
    return el('section', { class: 'tree' }, el('h2', {}, this.face.family ? `Family ${this.face.family}` : 'Family'),
      row('Parents', parents.map((parent) => cell(parent.name, parent.face, gave(parent), parent.head))),
      row('Sisters and brothers', siblings.map((face) => cell(face.id, face, ''))),
      row('Children', children.map((face) => cell(face.id, face, face.family ?? ''))));
  }

  /// The values of a region, or of one of its bands, and the heads with weight in it.
  lends(numbers) {
    const all = Object.entries(numbers.weights).sort((a, b) => b[1] - a[1]);
    const weights = all.filter(([, weight]) => weight >= 0.005);
    const rest = all.length - weights.length;
    return [
      el('div', { class: 'numbers' },
        this.meter('Smoothness', numbers.smoothness, 1, `${numbers.iterations} iterations`),
        this.meter('Strength', numbers.extrapolation, 2, 'extrapolation')),
      weights.map(([head, weight]) => el('div', { class: 'weight', title: `${head}: ${short(weight, 3)}` },
        el('span', {}, head), el('div', { class: 'bar' },
          el('i', { style: `width:${Math.max(0, Math.min(100, 100 * weight))}%` })),
        el('span', { class: 'number' }, `${short(100 * weight, 0)} %`))),
      rest > 0 ? el('small', { class: 'muted' },
        `and ${rest} more with less than half a percent each`) : null,
    ];
  }

  recipe() {
    const { face, crowd } = this;
    const from = (parent) => (parent
      ? el('small', {}, ` from the ${parent}, ${face.parents?.[parent] ?? ''}`) : null);
    const regions = Object.entries(face.regions).map(([name, region]) => {
      const inherited = face.inherits?.[name];
      return el('div', { class: 'region' },
        el('h3', {}, name === 'all' ? 'Whole head' : name, typeof inherited === 'string' ? from(inherited) : null),
        bandsOf(crowd, region).map(([band, numbers]) => [
          band ? el('h4', { class: 'band' }, band, from(inherited?.[band])) : null, this.lends(numbers)]));
    });
    return el('section', {}, el('h2', {}, 'Recipe'), regions);
  }

  meter(name, value, most, title) {
    return el('div', { class: 'meter', title }, el('span', {}, name), el('b', {}, short(value)),
      el('div', { class: 'bar' }, el('i', { style: `width:${Math.min(100, (100 * value) / most)}%` })));
  }

  neighbours() {
    const cells = this.face.near.map(({ id, mm }) => {
      const other = this.crowd.byId.get(id);
      return el('button', { class: 'neighbour', onclick: () => this.go(other), title: `Open ${id}` },
        picture(other, id), el('b', {}, shortName(this.crowd, id)), el('span', {}, `${short(mm)} mm`));
    });
    return el('section', {}, el('h2', {}, 'Nearest faces'),
      cells.length > 0 ? el('div', { class: 'neighbours' }, cells)
        : el('p', { class: 'muted' }, 'There is no other face.'));
  }

  /// \return whether the key has a function on this page
  key(event) {
    const table = this.turntable;
    const keys = {
      ArrowRight: () => this.step(1), ArrowLeft: () => this.step(-1),
      Home: () => this.go(this.faces[0]), End: () => this.go(this.faces.at(-1)), Escape: () => this.go(null),
      Backspace: () => this.go(null), n: () => this.side.querySelector('textarea').focus(),
      f: () => table?.view('front'), q: () => table?.view('three_quarter'),
      p: () => table?.view('profile'), t: () => this.compare(this.compared === 'target' ? 'face' : 'target'),
      c: () => this.face.near[0] && this.compare(this.compared === 'near' ? 'face' : 'near'),
      s: () => this.setDouble(!this.isDouble), ',': () => table?.turn(-10), '.': () => table?.turn(10),
    };
    const act = keys[event.key];
    act?.();
    return Boolean(act);
  }
}
