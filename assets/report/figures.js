// Figures, histograms, tree and tables of the page of kerf report, made of the data in it.
'use strict';


const {report, surface, solution} = JSON.parse(document.getElementById('data').textContent);
const byId = (id) => document.getElementById(id);
const totals = report.totals, isMeshed = totals.tets > 0, failed = report.parts.filter((part) => part.error);

const facetsOfFile = report.input.faces_of_file ?? report.input.remeshing?.facets_before ?? report.input.faces;

function make(tag, attributes = {}, ...children) {
    const element = /^(svg|g|rect|path|line|circle|text|title)$/.test(tag) ?
        document.createElementNS('http://www.w3.org/2000/svg', tag) :
        document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
}
const whole = (n) => n.toLocaleString('en-US', {maximumFractionDigits: 0});
const digits = (n, count = 4) => n === 0     ? '0' :
    Math.abs(n) >= 1e6 || Math.abs(n) < 1e-3 ? n.toExponential(count - 2) :
    Math.abs(n) >= 10 ** count               ? whole(n) :
                                               n.toLocaleString('en-US', {maximumSignificantDigits: count});
const seconds = (s) => s < 0.1 ? `${(1000 * s).toFixed(s < 0.01 ? 1 : 0)} ms` :
    s < 100 ? `${digits(s, 3)} s` :
              `${whole(s / 60)} min`;
const megabytes = (bytes) => `${whole(bytes / 1e6)} MB`;
const counted = (n, name) => `${whole(n)} ${name}${n === 1 ? '' : 's'}`;

// Colours of parts, patches and regions by their place.
const firstColours = [
    '#4e79a7', '#f28e2b', '#59a14f', '#d9575a', '#76b7b2', '#e3c13f', '#a87aa0', '#9c755f', '#ff9da7', '#7d9bd6',
    '#a3b84f', '#c96f9d'
];
const colourAt = (i) => i < firstColours.length ?
    firstColours[i] :
    `hsl(${Math.round(i * 137.508) % 360}, ${50 + 15 * (i % 3)}%, ${50 + 8 * (i % 2)}%)`;
const numberOfPart = new Map(surface.parts.map((part, i) => [part.id, i]));
const partColour = (id) => colourAt(numberOfPart.get(id));
const sides = ['outer surface', 'interface', 'wall between regions'];
const sideOf = (run) => run.neighbour < 0 ? 0 : run.patch < 0 ? 1 : 2;
const colourings = {
    part: {name: 'part', keys: surface.parts.map((part) => `${part.id}`), of: (part) => numberOfPart.get(part.id)},
    patch: {
        name: 'patch',
        keys: [...surface.patches, 'interface'],
        of: (part, run) => run.patch < 0 ? surface.patches.length : run.patch
    },
    region: {name: 'region', keys: surface.regions, of: (part) => part.region},
    sides: {
        name: 'kind of surface',
        of: (part, run) => sideOf(run),
        keys: sides.slice(
            0,
            surface.regions.length > 1   ? 3 :
                surface.parts.length > 1 ? 2 :
                                           1)
    },
};
if (failed.length > 0) {
    const numbers = new Set(failed.map((part) => part.id));
    colourings.outcome = {
        name: 'meshed or not',
        keys: ['meshed', 'failed'],
        of: (part) => numbers.has(part.id) ? 1 : 0
    };
}
// "VonMises pull" is the von Mises stress of the case pull.
const fieldName = (name) => name.replace(/^VonMises/, 'von Mises stress').replace(/^Displacement/, 'displacement');
surface.fields.forEach(({name}, field) => colourings[`value_${field}`] = {name: fieldName(name), keys: [], field});
const stressField = surface.fields.findIndex(({name}) => name.startsWith('VonMises'));
const firstField = `value_${Math.max(stressField, 0)}`;
if (surface.patches.length < 2) delete colourings.patch;
if (surface.regions.length < 2) delete colourings.region;

function showHead() {
    const {verification: laws} = report;
    byId('subtitle').textContent = [
        counted(surface.parts.length, 'part'),
        isMeshed ? `${whole(totals.tets)} tetrahedra` : 'surfaces of the parts, not meshed',
        `meshed by Kerf ${report.kerf}`.replace('meshed', isMeshed ? 'meshed' : 'divided')
    ].join(' · ');
    const fault = failed.length ? `${failed.length} of ${counted(report.parts.length, 'part')} failed` : 'not verified';
    const unsolved = (solution?.solve.cases ?? []).filter((each) => !each.converged);
    const holds = laws.passed && unsolved.length === 0;
    byId('verdict').textContent = !laws.passed ? `✗ ${fault}` :
        unsolved.length                        ? '✗ the solver has not reached its tolerance' :
        solution                               ? '✓ solved, on a verified mesh' :
                                                 '✓ verified: every law holds';
    byId('verdict').className = holds ? 'good' : 'bad';
    const angle = report.quality?.all?.min_dihedral_deg;
    const tiles = [[whole(surface.parts.length), surface.parts.length === 1 ? 'part' : 'parts']];
    if (isMeshed)
        tiles.push(
            [whole(totals.tets), 'tetrahedra'], [whole(totals.vertices), 'vertices'],
            [`${digits(angle.min, 3)}°`, `smallest dihedral angle; 1 % below ${digits(angle.p1, 3)}°`]);
    const most = (key) => Math.max(...solution.solve.cases.map((each) => each[key].value));
    if (solution) tiles.push([whole(solution.solve.unknowns), 'unknowns']);
    if (solution?.solve.cases?.length)
        tiles.push(
            [digits(most('max_displacement')), 'largest displacement'],
            [digits(most('max_von_mises')), 'largest von Mises stress']);
    tiles.push([whole(facetsOfFile), 'facets of the file']);
    if (report.input.faces !== facetsOfFile)
        tiles.push([whole(report.input.faces), 'facets of the mesh\'s surface']);
    tiles.push(
        [digits(totals.volume), 'volume'],
        [seconds(totals.wall_seconds), 'wall clock'], [megabytes(totals.peak_rss_bytes), 'memory, most of a process']);
    byId('tiles').append(
        ...tiles.map(([value, name]) => make('div', {}, make('b', {}, value), make('span', {}, name))));
    if (surface.triangles !== surface.triangles_of_run)
        byId('coarser').textContent = `The surface is drawn by ${whole(surface.triangles)} triangles of the ` +
            `${whole(surface.triangles_of_run)} that the boundaries of the parts have` +
            (surface.joins > 0 ? ': vertices nearer than about ' + digits(surface.step * 2 ** surface.joins, 2) +
                     ' are one, so that the page can be sent by mail. ' :
                                 '; the rest are too small to be seen. ') +
            'All figures are of the whole.';
}

// Histograms

const measures = {
    min_dihedral_deg: ['Smallest dihedral angle', '°'],
    max_dihedral_deg: ['Largest dihedral angle', '°'],
    shape: ['Shape, 1 is regular', ''],
    aspect: ['Aspect ratio, 1 is regular', ''],
    radius_edge: ['Radius to edge', ''],
    volume: ['Volume of a cell', ''],
    min_edge: ['Shortest edge', ''],
    max_edge: ['Longest edge', ''],
};

function histogram(name) {
    const [title, unit] = measures[name], all = report.quality.all[name], near = report.quality.interface?.[name];
    const {edges, counts} = all.histogram, some = counts.map((c, i) => c > 0 ? i : -1).filter((i) => i >= 0);
    const first = Math.max(some[0] - 1, 0), last = Math.min(some.at(-1) + 1, counts.length - 1);
    const width = 260, height = 108, base = 90, most = Math.max(...counts), bar = width / (last - first + 1);
    const svg = make('svg', {
        viewBox: `0 0 ${width} ${height}`,
        role: 'img',
        'aria-label': `${title}: from ${digits(all.min)} to ${digits(all.max)}`
    });
    for (let i = first; i <= last; ++i) {
        const x = (i - first) * bar,
              tip = `${digits(edges[i], 3)} to ${digits(edges[i + 1], 3)}: ${whole(counts[i])} cells`;
        [['all', counts[i]], ['part', near?.histogram.counts[i] ?? 0]].forEach(([kind, count]) => {
            const up = count > 0 ? Math.max(count / most * 84, 0.8) : 0;
            svg.append(make(
                'rect', {class: kind, x: x + 0.5, y: base - up, width: Math.max(bar - 1, 0.5), height: up},
                make('title', {}, tip)));
        });
    }
    svg.append(make('line', {class: 'rule', x1: 0, x2: width, y1: base, y2: base}));
    const ticks = [first, Math.round((first + last + 1) / 2), last + 1];
    ticks.forEach(
        (i, k) => svg.append(make(
            'text', {x: (i - first) * bar, y: base + 14, 'text-anchor': ['start', 'middle', 'end'][k]},
            digits(edges[i], 3) + unit)));
    const words = [['min', 'least'], ['p1', '1 %'], ['median', 'median'], ['max', 'most']].map(
        ([key, word]) => make('div', {}, make('dt', {}, word), make('dd', {}, `${digits(all[key], 3)}${unit}`)));
    return make('div', {}, make('h3', {}, title), svg, make('dl', {}, ...words));
}

function sharpWords(place) {
    const where = [`part ${place.part}`, place.region && `region ${place.region}`, place.patch && `patch ${place.patch}`]
                      .filter(Boolean)
                      .join(', ');
    return `${counted(place.tets, 'cell')} below ${report.sharp.below_deg}°, the worst of ` +
        `${digits(place.min_dihedral_deg, 2)}° at (${place.point.map((x) => digits(x)).join(', ')}) in ${where}: ` +
        `${place.why}. ${place.way_out}`;
}

function showQuality() {
    if (!isMeshed) return byId('quality').remove();
    const hasInterfaces = surface.parts.length > 1;
    byId('quality-note').textContent =
        `All ${whole(totals.tets)} cells` + (hasInterfaces ? '; darker: those with a vertex on an interface.' : '.');
    byId('sharp').append(...(report.sharp?.places ?? []).map((place) => make('li', {}, sharpWords(place))));
    byId('histograms').append(...Object.keys(measures).filter((name) => report.quality.all[name]).map(histogram));
}

// Tree

const mostLevels = 5;  // that are drawn: 32 nodes side by side

function treeLayout(root, deepest) {
    const nodes = new Map(report.tree.map((node) => [node.id, node])), placed = [];
    let next = 0;
    const place = (id, level) => {
        const below = level < deepest ? [2 * id, 2 * id + 1].filter((child) => nodes.has(child)) : [];
        const children = below.map((child) => place(child, level + 1));
        const x = children.length ? children.reduce((sum, c) => sum + c.x, 0) / children.length : next++;
        const item = {node: nodes.get(id), level, x, children};
        placed.push(item);
        return item;
    };
    place(root, 0);
    return {placed, leaves: next};
}

function cutWords(node) {
    if (!node.cut) return `${counted(node.leaves, 'part')}, volume ${digits(node.volume)}`;
    const {cut} = node;
    return `node ${node.id}: ${counted(node.leaves, 'part')}; cut by ${cut.method}, contour of ${cut.contour_edges} ` +
        `edges, interface ${digits(cut.interface_area)} in ${whole(cut.interface_faces)} triangles, angles from ` +
        `${digits(cut.min_interface_angle_deg, 3)}°`;
}

function showTree(choose) {
    if (report.tree.length < 2) return byId('tree-section').remove();
    const levels = Math.floor(Math.log2(Math.max(...report.tree.map((node) => node.id))));
    const {placed, leaves} = treeLayout(1, Math.min(levels, mostLevels)), down = 62;
    const across = Math.max(26, Math.min(96, 1100 / leaves)), width = across * leaves;
    const shown = Math.max(...placed.map((item) => item.level));
    const svg = make('svg', {width, height: down * shown + 64, role: 'group', 'aria-label': 'Tree of the cuts'});
    const at = (item) => [(item.x + 0.5) * across, 20 + item.level * down];
    for (const item of placed)
        for (const child of item.children) {
            const [x, y] = at(item), [cx, cy] = at(child);
            svg.append(make('path', {class: 'rule', d: `M${x} ${y}C${x} ${y + 30} ${cx} ${cy - 30} ${cx} ${cy}`}));
        }
    const largest = report.tree[0].volume;
    for (const item of placed) {
        const {node} = item, [x, y] = at(item), leaf = numberOfPart.has(node.id);
        const radius = Math.min(14, 4.5 + 9.5 * Math.sqrt(Math.abs(node.volume / largest)));
        const dot = make('circle', {r: radius});
        if (leaf) dot.style.fill = partColour(node.id);
        const more = !leaf && item.children.length === 0 ? ` (${node.leaves})` : '';
        const group = make(
            'g', {
                class: 'node',
                transform: `translate(${x} ${y})`,
                tabindex: 0,
                role: 'button',
                'data-node': node.id,
                'aria-label': cutWords(node)
            },
            make('title', {}, cutWords(node)), dot, make('text', {y: radius + 13}, `${node.id}${more}`));
        const act = () => choose(leaf ? {part: node.id, branch: 0} : {part: 0, branch: node.id});
        group.addEventListener('click', act);
        group.addEventListener('keydown', (event) => {
            if (event.key === 'Enter') act();
        });
        svg.append(group);
    }
    byId('tree-note').textContent =
        'Each node is a subdomain, which a cut divides in two; its area is its volume\'s. ' +
        'Click one to see its parts above.' +
        (levels > mostLevels ?
             ` The ${mostLevels} uppermost levels of ${levels} are drawn, with the number of parts below.` :
             '');
    byId('tree').append(svg);
    showCuts();
}

// Tables: columns are [title, key or function, format, has words].

function table(rows, columns, onRow) {
    const body = make('tbody'), head = make('tr');
    const value = (row, key) => typeof key === 'function' ? key(row) : row[key];
    const fill = (sorted) => body.replaceChildren(...sorted.map((row) => {
        const line = make('tr', {'data-row': row.id, tabindex: 0});
        for (const [, key, format, words] of columns)
            line.append(make('td', words ? {class: 'words'} : {}, ...[format(value(row, key), row)].flat()));
        if (onRow) line.addEventListener('click', () => onRow(row));
        if (onRow)
            line.addEventListener('keydown', (event) => {
                if (event.key === 'Enter') onRow(row);
            });
        return line;
    }));
    columns.forEach(([title, key, , words]) => {
        const button = make('button', {type: 'button'}, title),
              cell = make('th', words ? {class: 'words'} : {}, button);
        button.addEventListener('click', () => {
            const up = cell.getAttribute('aria-sort') !== 'ascending';
            head.querySelectorAll('th').forEach((other) => other.removeAttribute('aria-sort'));
            cell.setAttribute('aria-sort', up ? 'ascending' : 'descending');
            const order = (a, b) => typeof a === 'number' ? a - b : `${a}`.localeCompare(`${b}`);
            fill([...rows].sort((a, b) => (up ? 1 : -1) * order(value(a, key), value(b, key))));
        });
        head.append(cell);
    });
    fill(rows);
    return make('table', {}, make('thead', {}, head), body);
}

const volumeOf = (part) => part.volume || part.surface_volume;  // of one that has no mesh, its surface's
const text = (value) => `${value ?? ''}`;

function showParts(choose) {
    const swatch = (id) => make('span', {class: 'swatch', style: `background:${partColour(id)}`});
    const columns = [['Part', 'id', (id) => [swatch(id), ` ${id}`], true]];
    if (surface.regions.length > 1)
        columns.push(
            ['Region', (part) => surface.regions[surface.parts[numberOfPart.get(part.id)].region], text, true]);
    if (isMeshed) columns.push(['Tetrahedra', 'tets', whole], ['Vertices', 'vertices', whole]);
    columns.push(
        ['Volume', volumeOf, (v) => digits(v, 5)],
        ['Boundary triangles', 'surface_faces', whole], ['Interface area', 'interface_area', (v) => digits(v)],
        ['Neighbours', (part) => part.neighbours.length, (_, part) => part.neighbours.join(', '), true]);
    if (isMeshed)
        columns.push(
            ['Smallest angle', (part) => part.min_dihedral_deg ?? '', (a) => a === '' ? '' : `${digits(a, 3)}°`],
            ['Mesher', 'mesher', text, true], ['Attempts', 'attempts', whole], ['Time', 'seconds', seconds],
            ['Memory', 'peak_rss_bytes', megabytes]);
    if (failed.length) columns.push(['Failed', (part) => part.error ?? '', text, true]);
    byId('part-table').append(table(report.parts, columns, (part) => choose({part: part.id, branch: 0})));
}

function showRegions() {
    const regions = report.input.regions ?? [];
    if (regions.length < 2) return byId('regions').remove();
    const rows = regions.map((region, i) => {
        const own = report.parts.filter((part) => part.region === i), sum = (key) => own.reduce((n, p) => n + p[key], 0);
        const angles = own.map((part) => part.min_dihedral_deg).filter((angle) => angle !== null && angle !== undefined);
        return {...region, id: i, parts: own.length, tets: sum('tets'), angle: angles.length ? Math.min(...angles) : NaN};
    });
    const swatch = (i) => make('span', {class: 'swatch', style: `background:${colourAt(i)}`});
    const columns = [
        ['Region', 'name', (name, row) => [swatch(row.id), ` ${name}`], true], ['Volume', 'volume', (v) => digits(v, 5)]
    ];
    if (isMeshed)
        columns.push(
            ['Tetrahedra', 'tets', whole],
            ['Smallest angle', 'angle', (angle) => Number.isNaN(angle) ? '' : `${digits(angle, 3)}°`]);
    columns.push(
        ['Area', 'area', (a) => digits(a)], ['Facets', 'faces', whole], ['Shells', 'components', whole],
        ['Parts', 'parts', whole]);
    byId('region-table').append(table(rows, columns));
}

// The solution of kerf solve

const vector = (v) => `(${v.map((x) => digits(x)).join(', ')})`;

function caseFigures(each) {
    const figures = list(each.name || 'Load', [
        ['load', vector(each.load)], ['largest displacement', digits(each.max_displacement.value)],
        ['at', vector(each.max_displacement.at)], ['largest von Mises stress', digits(each.max_von_mises.value)],
        ['at', vector(each.max_von_mises.at)],
        ['estimated error, energy norm', `${digits(100 * each.relative_error, 3)} %`],
        ['loads and reactions differ by', digits(each.imbalance, 2)],
        ['solver', `${each.iterations} iterations, residual ${digits(each.residual, 2)}`, !each.converged]
    ]);
    const reactions = table(each.reactions.map((reaction, id) => ({...reaction, id})), [
        ['Support', 'support', text, true], ['Reaction', 'reaction', vector, true], ['Moment', 'moment', vector, true],
        ['about', 'about', vector, true]
    ]);
    return make('div', {class: 'case'}, make('div', {class: 'columns'}, figures), make('div', {class: 'scroll'}, reactions));
}

function showSolution() {
    if (!solution) return byId('solution').remove();
    const {solve} = solution;
    byId('solution-note').textContent = `${solve.case_file}: elements of order ${solve.order}, ` +
        `${counted(solve.nodes, 'node')}, ${counted(solve.unknowns, 'unknown')}. Units are those of the surface and the ` +
        'case. Colours above are values at the vertices of the surface.';
    byId('cases').append(...(solve.cases ?? []).map(caseFigures));
    if (solve.modes)
        byId('cases').append(table(solve.modes.map((mode, id) => ({...mode, id: id + 1})), [
            ['Mode', 'id', whole], ['Frequency', 'frequency', (f) => digits(f, 5)],
            ['Rigid', 'rigid', (rigid) => rigid ? 'yes' : 'no', true],
            ['Moves most at', (mode) => mode.max_displacement.at, vector, true]
        ]));
    byId('cases').append(make('div', {class: 'case'}, make('div', {class: 'columns'}, list(
        'Materials', (solve.materials ?? []).map(
            (material) => [material.name, `E ${digits(material.young)}, ν ${digits(material.poisson)}`])))));
}

function showCuts() {
    const rows = report.tree.filter((node) => node.cut);
    if (rows.length === 0) return byId('cuts-details').remove();
    byId('cut-table').append(table(rows, [
        ['Node', 'id', text, true], ['Parts', 'leaves', whole], ['Contour by', (n) => n.cut.method, text, true],
        ['Accepted at', (n) => n.cut.rung, text, true], ['Tries', (n) => n.cut.tries, whole],
        ['Contour edges', (n) => n.cut.contour_edges, whole],
        ['Contour length', (n) => n.cut.contour_length, (v) => digits(v)],
        ['From the plane at most', (n) => n.cut.max_deviation, (v) => digits(v, 3)],
        ['Interface area', (n) => n.cut.interface_area, (v) => digits(v)],
        ['Triangles', (n) => n.cut.interface_faces, whole],
        ['Smallest angle', (n) => n.cut.min_interface_angle_deg, (v) => `${digits(v, 3)}°`],
        ['Time', (n) => n.cut.seconds, seconds]
    ]));
}

// The run

const stages = ['read', 'decompose', 'prepare', 'mesh', 'write', 'hash'];

function showTime() {
    const of = stages.map((name) => [name, totals[`${name}_seconds`] ?? 0]);
    const rest = totals.wall_seconds - of.reduce((sum, [, s]) => sum + s, 0);
    if (rest > 0.005 * totals.wall_seconds) of.push(['other', rest]);
    const bar = make('div', {class: 'stages', role: 'img', 'aria-label': 'Time of the stages'}),
          keys = make('div', {class: 'keys'});
    of.filter(([, s]) => s > 0).forEach(([name, s], i) => {
        bar.append(
            make('span', {style: `flex:${1000 * s};background:${colourAt(i)}`, title: `${name}: ${seconds(s)}`}));
        keys.append(make(
            'span', {}, make('span', {class: 'swatch', style: `background:${colourAt(i)}`}), ` ${name} ${seconds(s)}`));
    });
    byId('time').append(make('h3', {}, `Wall clock: ${seconds(totals.wall_seconds)}`), bar, keys);
}

function list(title, rows) {
    const items =
        rows.filter(([, value]) => value !== null && value !== undefined)
            .flatMap(([name, value, bad]) => [make('dt', {}, name), make('dd', bad ? {class: 'bad'} : {}, `${value}`)]);
    return make('div', {}, make('h3', {}, title), make('dl', {}, ...items));
}

function showRun() {
    showTime();
    const {input, verification: laws} = report;
    const spelled = (name) => name.replaceAll('_', ' ');
    const repairs =
        Object.entries(input.repairs ?? {}).filter(([, n]) => n > 0).map(([name, n]) => [spelled(name), whole(n)]);
    const cuts = report.tree.map((node) => node.cut).filter(Boolean);
    const worst = cuts.length ? Math.min(...cuts.map((cut) => cut.min_interface_angle_deg)) : 0;
    const ways = Object.entries(totals.parts_by_way ?? {}).map(([way, n]) => [`parts filled by ${way}`, whole(n)]);
    const columns = [
        list(
            'Read',
            [
                ['facets of the file', whole(facetsOfFile)],
                ['facets of the mesh\'s surface', whole(input.faces)], ['its vertices', whole(input.vertices)],
                ['components', input.components],
                ['genus', input.genus], ['volume', digits(input.volume, 6)], ['area', digits(input.area, 6)],
                ...(repairs.length ? repairs : [['repairs', 'none']])
            ]),
        list(
            'Cut',
            [
                ['cuts', cuts.length], ['needed more than one try', cuts.filter((cut) => cut.tries > 1).length],
                ['interface area', digits(totals.interface_area)],
                ['smallest angle on an interface', cuts.length ? `${digits(worst, 3)}°` : null],
                ['slowest to mean worker', digits(totals.imbalance, 3)]
            ]),
    ];
    if (isMeshed)
        columns.push(list('Meshed', [
            ['tetrahedra', whole(totals.tets)], ['vertices', whole(totals.vertices)], ['order', totals.order],
            ['nodes', totals.order > 1 ? whole(totals.nodes) : null], ...ways,
            ['facets recovered', whole(totals.recovery?.missing ?? 0)], ['facets divided', whole(totals.split_facets)],
            ['edges removed by improvement', report.improvement ? whole(report.improvement.removed_edges) : null]
        ]));
    const isBad = (name, value) =>
        typeof value === 'number' && value > (name === 'volume_rel_error' ? laws.volume_rel_bound : 0);
    columns.push(list(
        'Verified',
        Object.entries(laws)
            .filter(([name]) => name !== 'passed' && name !== 'volume_rel_bound')
            .map(
                ([name, value]) =>
                    [spelled(name).replace('rel', 'relative'), typeof value === 'number' ? digits(value, 3) : value,
                     isBad(name, value)])));
    byId('columns').append(...columns);
    byId('options').append(make(
        'dl', {},
        ...Object.entries(report.options)
            .map(
                ([name, value]) => make(
                    'div', {}, make('dt', {}, name),
                    make(
                        'dd', {},
                        value === ''             ? '–' :
                            Array.isArray(value) ? value.join(', ') || '–' :
                                                   `${value}`)))));
    byId('footer').textContent = `Made by kerf report ${report.kerf}` +
        (report.mesh_hash ? ` · mesh ${report.mesh_hash}` : '') +
        ` · input ${report.input.hash} · drawn with three.js (MIT)`;
}
