// What the controls of the page of kerf report do. A view can be sent as a link, since the address says it:
//   turn=35,25  azimuth and tilt in degrees   zoom=1  pan=0,0  explode=0..1
//   clip=x,0.5  what is below that share of the box along x is left; -x: above
//   colour=part|patch|region|sides|outcome|value_0   hide=outer,interfaces,contours   show=edges,cuts
//   part=8 or branch=4  what is chosen   only=1  the rest is hidden   pick=400,300  choose by a place of the picture
//   check=1  for tests: the body's data says the triangles drawn, the share of pixels covered, and a digest of them
'use strict';

const initial = {
    turn: [35, 25],
    zoom: 1,
    pan: [0, 0],
    explode: 0,
    axis: '',
    clip: 0.5,
    // What one looks for first: where it failed, the stresses, the regions.
    colour: ['outcome', firstField, 'region'].find((name) => colourings[name]) ?? 'part',
    outer: true,
    interfaces: true,
    contours: true,
    edges: false,
    cuts: false,
    part: 0,
    branch: 0,
    only: false
};

function stateOfAddress() {
    const given = new URLSearchParams(location.hash.slice(1)), state = structuredClone(initial);
    const numbers = (name) => (given.get(name) ?? '').split(',').map(Number).filter(Number.isFinite);
    for (const name of ['turn', 'pan'])
        if (given.has(name) && numbers(name).length === 2) state[name] = numbers(name);
    for (const name of ['zoom', 'explode', 'part', 'branch'])
        if (given.has(name)) state[name] = numbers(name)[0] ?? state[name];
    const clip = /^(-?[xyz]),([0-9.]+)$/.exec(given.get('clip') ?? '');
    if (clip) [state.axis, state.clip] = [clip[1], Math.min(Number(clip[2]), 1)];
    if (colourings[given.get('colour')]) state.colour = given.get('colour');
    for (const name of (given.get('hide') ?? '').split(','))
        if (name in state) state[name] = false;
    for (const name of (given.get('show') ?? '').split(','))
        if (name in state) state[name] = true;
    state.only = given.get('only') === '1';
    state.zoom = Math.min(Math.max(state.zoom, 0.05), 200);
    return {state, pick: numbers('pick'), check: given.get('check') === '1'};
}

function addressOfState(state) {
    const short = (n) => `${Number(n.toFixed(3))}`, words = [],
          same = (name) => `${state[name]}` === `${initial[name]}`;
    for (const name of ['turn', 'pan'])
        if (!same(name)) words.push(`${name}=${state[name].map(short).join(',')}`);
    for (const name of ['zoom', 'explode', 'part', 'branch'])
        if (!same(name)) words.push(`${name}=${short(state[name])}`);
    if (state.axis) words.push(`clip=${state.axis},${short(state.clip)}`);
    if (!same('colour')) words.push(`colour=${state.colour}`);
    const hidden = ['outer', 'interfaces', 'contours'].filter((name) => !state[name]);
    const shown = ['edges', 'cuts'].filter((name) => state[name]);
    if (hidden.length) words.push(`hide=${hidden.join(',')}`);
    if (shown.length) words.push(`show=${shown.join(',')}`);
    if (state.only) words.push('only=1');
    return `#${words.join('&')}`;
}

class Page {
    constructor(view) {
        this.view = view;
        this.state = initial;
        this.colours = matchMedia('(prefers-color-scheme: dark)');
        byId('colour').append(...Object.entries(colourings).map(([key, {name}]) => make('option', {value: key}, name)));
        for (const name of ['interfaces', 'contours', 'cuts'])
            byId(name).parentNode.hidden =
                surface.parts.length < 2 || name === 'cuts' && view.cuts.children.length === 0;
        this.listen();
    }

    listen() {
        for (const name of ['outer', 'interfaces', 'contours', 'edges', 'cuts'])
            byId(name).addEventListener('change', (event) => this.change({[name]: event.target.checked}));
        for (const name of ['explode', 'clip'])
            byId(name).addEventListener('input', (event) => this.change({[name]: Number(event.target.value)}));
        for (const name of ['axis', 'colour'])
            byId(name).addEventListener('change', (event) => this.change({[name]: event.target.value}));
        byId('controls').addEventListener('submit', (event) => event.preventDefault());
        byId('reset').addEventListener('click', () => this.change(structuredClone(initial)));
        byId('link').addEventListener('click', () => {
            const said = byId('link').textContent;
            navigator.clipboard?.writeText(location.href).then(() => {
                byId('link').textContent = 'Copied';
                setTimeout(() => byId('link').textContent = said, 1500);
            }, () => prompt('The link to this view:', location.href));
        });
        addEventListener('hashchange', () => this.readAddress());
        this.colours.addEventListener('change', () => this.change({}));
        new ResizeObserver(() => this.view.draw(this.state)).observe(this.view.canvas);
        this.listenToMouse(this.view.canvas);
        this.view.canvas.addEventListener('keydown', (event) => this.onKey(event));
    }

    listenToMouse(canvas) {
        let from = null;
        canvas.addEventListener('contextmenu', (event) => event.preventDefault());
        canvas.addEventListener('pointerdown', (event) => {
            canvas.setPointerCapture(event.pointerId);
            const moves = event.button === 2 || event.shiftKey;
            from =
                {x: event.clientX, y: event.clientY, turn: this.state.turn, pan: this.state.pan, moves, dragged: false};
        });
        canvas.addEventListener('pointermove', (event) => {
            if (!from) return;
            const dx = event.clientX - from.x, dy = event.clientY - from.y, scale = this.view.perPixel;
            if (Math.hypot(dx, dy) > 3) from.dragged = true;
            if (!from.dragged) return;
            if (from.moves)
                this.move({pan: [from.pan[0] + dx * scale, from.pan[1] - dy * scale]});
            else
                this.turnTo(from.turn[0] - 0.4 * dx, from.turn[1] + 0.4 * dy);
        });
        canvas.addEventListener('pointerup', (event) => {
            if (from && !from.dragged) this.pickAt(event.offsetX, event.offsetY);
            from = null;
        });
        canvas.addEventListener('pointercancel', () => from = null);
        canvas.addEventListener('wheel', (event) => {
            event.preventDefault();
            this.zoomBy(Math.exp(-0.0015 * event.deltaY));
        }, {passive: false});
    }

    onKey(event) {
        const [turn, tilt] = this.state.turn;
        const actions = {
            ArrowLeft: () => this.turnTo(turn + 5, tilt),
            ArrowRight: () => this.turnTo(turn - 5, tilt),
            ArrowUp: () => this.turnTo(turn, tilt - 5),
            ArrowDown: () => this.turnTo(turn, tilt + 5),
            '+': () => this.zoomBy(1.2),
            '=': () => this.zoomBy(1.2),
            '-': () => this.zoomBy(1 / 1.2),
            '0': () => this.change({turn: initial.turn, zoom: 1, pan: [0, 0]}),
            Escape: () => this.choose({part: 0, branch: 0}),
        };
        if (!actions[event.key] || event.ctrlKey || event.metaKey) return;
        event.preventDefault();
        actions[event.key]();
    }

    turnTo(turn, tilt) {
        this.move({turn: [((turn + 180) % 360 + 360) % 360 - 180, Math.min(Math.max(tilt, -90), 90)]});
    }
    zoomBy(factor) {
        this.move({zoom: Math.min(Math.max(this.state.zoom * factor, 0.05), 200)});
    }
    pickAt(x, y) {
        this.choose({part: this.view.pick(x, y)?.id ?? 0, branch: 0});
    }
    choose(what) {
        this.change({...what, only: this.state.only && (what.part > 0 || what.branch > 0)});
    }

    // The camera alone: everything else is as it was.
    move(changes) {
        this.state = {...this.state, ...changes};
        cancelAnimationFrame(this.frame);
        this.frame = requestAnimationFrame(() => this.view.draw(this.state));
        this.writeAddress();
    }
    change(changes) {
        this.state = {...this.state, ...changes};
        this.show();
        this.writeAddress();
    }
    readAddress() {
        const {state, pick, check} = stateOfAddress();
        this.state = state;
        this.show();
        if (pick.length === 2) this.pickAt(...pick);
        Object.assign(
            document.body.dataset, {ready: 1, drawn: this.view.drawn, part: this.state.part},
            check ? this.view.check() : {});
    }
    writeAddress() {
        clearTimeout(this.writing);
        this.writing = setTimeout(() => history.replaceState(null, '', addressOfState(this.state)), 300);
    }

    chosen() {
        const {part, branch} = this.state;
        return new Set(branch > 0 ? this.view.below(branch).map((each) => each.id) : part > 0 ? [part] : []);
    }

    show() {
        const chosen = this.chosen(), {of, field} = colourings[this.state.colour],
              dim = this.colours.matches ? '#4a5058' : '#c3c7cc';
        const isChosen = (part) => chosen.size === 0 || chosen.has(part.id);
        this.view.show(
            this.state,
            (part, run) => !isChosen(part) ? dim :
                field === undefined        ? colourAt(of(part, run)) :
                                             byValue,
            (part) => !this.state.only || isChosen(part), this.colours.matches ? '#e7e9eb' : '#14181c', field);
        for (const name of ['outer', 'interfaces', 'contours', 'edges', 'cuts']) byId(name).checked = this.state[name];
        for (const name of ['explode', 'clip', 'axis', 'colour']) byId(name).value = this.state[name];
        byId('clip').disabled = this.state.axis === '';
        for (const row of document.querySelectorAll('#part-table tr[data-row]'))
            row.classList.toggle('chosen', chosen.has(Number(row.dataset.row)));
        for (const node of document.querySelectorAll('#tree .node'))
            node.classList.toggle('chosen', [this.state.part, this.state.branch].includes(Number(node.dataset.node)));
        this.showLegend(chosen);
        this.showPicked(chosen);
    }

    showLegend(chosen) {
        const {keys, field} = colourings[this.state.colour], isParts = this.state.colour === 'part', most = 200;
        if (field !== undefined) {
            const {least, most: largest} = surface.fields[field];
            return byId('legend').replaceChildren(
                digits(least),
                make('span', {class: 'scale', style: `background:linear-gradient(to right,${valueStops.join()})`}),
                digits(largest));
        }
        byId('legend').replaceChildren(
            ...keys.slice(0, most).map((key, i) => {
                const swatch = make('span', {class: 'swatch', style: `background:${colourAt(i)}`});
                const button = make('button', {type: 'button', title: key}, swatch, key);
                if (isParts) {
                    const id = surface.parts[i].id;
                    button.setAttribute('aria-pressed', chosen.has(id));
                    button.addEventListener(
                        'click', () => this.choose({part: id === this.state.part ? 0 : id, branch: 0}));
                }
                return button;
            }),
            keys.length > most ? `and ${keys.length - most} more` : '');
    }

    showPicked(chosen) {
        const parts = report.parts.filter((part) => chosen.has(part.id)), box = byId('picked');
        if (parts.length === 0)
            return box.replaceChildren('Nothing is chosen: click a part here, in the tree or in the table.');
        const sum = (of) => parts.reduce((total, part) => total + of(part), 0), one = parts.length === 1 && parts[0];
        const rows = [['volume', digits(sum(volumeOf), 5)]];
        if (isMeshed) rows.unshift(['tetrahedra', whole(sum((part) => part.tets))]);
        if (one)
            rows.push(
                ['interface area', digits(one.interface_area)], ['neighbours', one.neighbours.join(', ') || 'none']);
        if (one && isMeshed) rows.push(['mesher', one.mesher], ['time', seconds(one.seconds)]);
        if (one && one.error) rows.push(['failed', one.error]);
        const only = make('input', {type: 'checkbox', id: 'only'});
        only.checked = this.state.only;
        only.addEventListener('change', () => this.change({only: only.checked}));
        box.replaceChildren(
            make('b', {}, one ? `Part ${one.id}` : `Node ${this.state.branch}: ${counted(parts.length, 'part')}`),
            make('dl', {}, ...rows.flatMap(([name, value]) => [make('dt', {}, name), make('dd', {}, value)])),
            make('label', {}, only, ' nothing else'));
        const row = one && document.querySelector(`#part-table tr[data-row="${one.id}"]`), list = byId('part-table');
        if (row) list.scrollTop = row.offsetTop - list.clientHeight / 2;
    }
}

let page = null;
const choose = (what) => page?.choose(what);
showHead();
showSolution();
showQuality();
showRegions();
showTree(choose);
showParts(choose);
showRun();
unpackedParts(surface, byId('surface').textContent.trim())
    .then((parts) => {
        page = new Page(new View(byId('canvas'), surface, parts, report.tree, initial.turn));
        page.readAddress();
    })
    .catch((error) => {
        byId('message').textContent = 'The surface cannot be shown: this browser has no WebGL 2, or none that works ' +
            `(${error.message}). All figures are below.`;
        document.body.dataset.ready = 'failed';
    });
