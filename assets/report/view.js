// The surface in the page of kerf report: decoded, drawn, picked. It knows nothing of the rest of the page.
'use strict';

// Colours of values from the least to the most, as bytes in the linear space in which light is added up.
const valueStops = ['#3b1f6e', '#2a6f9e', '#27a384', '#a5c93b', '#fbe04a'];
const valueColours = Array.from({length: 256}, (_, i) => {
    const place = i / 255 * (valueStops.length - 1), from = Math.min(Math.floor(place), valueStops.length - 2);
    const byte = (stop, k) => parseInt(stop.slice(1 + 2 * k, 3 + 2 * k), 16);
    return [0, 1, 2].map((k) => {
        const mixed =
            byte(valueStops[from], k) + (place - from) * (byte(valueStops[from + 1], k) - byte(valueStops[from], k));
        return Math.round(255 * (mixed / 255) ** 2.2);
    });
});
const byValue = 'values';  // in the place of a colour

// What packed_surface() (kernel/html/packed_surface.h) has made.
class PackedNumbers {
    constructor(bytes) {
        this.bytes = bytes;
        this.place = 0;
    }
    next() {
        let value = 0, factor = 1, byte;
        do {
            byte = this.bytes[this.place++];
            value += (byte & 127) * factor;
            factor *= 128;
        } while (byte > 127);
        return value % 2 ? -(value + 1) / 2 : value / 2;
    }
}

async function unpackedParts(surface, base64) {
    const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    const numbers = new PackedNumbers(new Uint8Array(await new Response(stream).arrayBuffer()));
    return surface.parts.map((part) => {
        const steps = new Uint16Array(3 * part.vertices), corners = new Uint32Array(3 * part.triangles);
        for (let i = 0; i < steps.length; ++i) steps[i] = (i < 3 ? 0 : steps[i - 3]) + numbers.next();
        let first = 0;
        for (let i = 0; i < corners.length; i += 3) {
            first += numbers.next();
            corners[i] = first;
            corners[i + 1] = first + numbers.next();
            corners[i + 2] = first + numbers.next();
        }
        const colours = surface.fields.map(() => {
            const colour = new Uint8Array(3 * part.vertices);
            for (let i = 0; i < colour.length; i += 3) colour.set(valueColours[numbers.next()], i);
            return colour;
        });
        return {...part, steps, corners, colours};
    });
}

const edgeKey = (a, b) => a < b ? a * 67108864 + b : b * 67108864 + a;

// The ends of edges of triangles [from, to): each once, or only those that one triangle alone has.
function edgesOf(corners, ranges, onlyOnce) {
    const keys = new Float64Array(ranges.reduce((sum, [from, to]) => sum + 3 * (to - from), 0));
    let count = 0;
    for (const [from, to] of ranges)
        for (let t = 3 * from; t < 3 * to; t += 3)
            for (let i = 0; i < 3; ++i) keys[count++] = edgeKey(corners[t + i], corners[t + (i + 1) % 3]);
    keys.sort();
    const ends = [];
    for (let i = 0, j = 0; i < count; i = j) {
        while (j < count && keys[j] === keys[i]) ++j;
        if (!onlyOnce || j - i === 1) ends.push(Math.floor(keys[i] / 67108864), keys[i] % 67108864);
    }
    return ends;
}

// parts: of unpackedParts(). tree: nodes with id and perhaps cut.plane. Lengths in the scene: the longest side of the
// run's box is 1, and the box's middle is the origin. firstTurn: azimuth and tilt for which the picture is fitted.
class View {
    constructor(canvas, surface, parts, tree, firstTurn) {
        this.canvas = canvas;
        this.surface = surface;
        this.parts = parts;
        this.tree = tree;
        this.firstTurn = firstTurn;
        this.nodes = new Map(tree.map((node) => [node.id, node]));
        this.renderer = new THREE.WebGLRenderer({canvas, alpha: true, antialias: true, preserveDrawingBuffer: true});
        this.scene = new THREE.Scene();
        this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -10, 10);
        this.light = new THREE.DirectionalLight(0xffffff, 2.1);
        this.scene.add(new THREE.AmbientLight(0xffffff, 1.25), this.light, this.light.target);
        this.materials = new Map();
        this.plane = new THREE.Plane();
        this.makeParts();
        this.makeCuts();
    }

    makeParts() {
        const box = new THREE.Box3(), high = [0, 0, 0];
        for (const part of this.parts)
            for (let i = 0; i < part.steps.length; ++i) high[i % 3] = Math.max(high[i % 3], part.steps[i]);
        this.side = Math.max(...high, 1);
        this.middle = high.map((h) => h / this.side / 2);
        box.min.set(...this.middle.map((m) => -m));
        box.max.set(...this.middle);
        this.box = box;
        for (const part of this.parts) {
            const places = new Float32Array(part.steps.length);
            for (let i = 0; i < places.length; ++i) places[i] = part.steps[i] / this.side - this.middle[i % 3];
            const position = new THREE.BufferAttribute(places, 3);
            part.geometry = new THREE.BufferGeometry();
            part.geometry.setAttribute('position', position);
            part.geometry.setIndex(new THREE.BufferAttribute(part.corners, 1));
            part.front = new THREE.Mesh(part.geometry, []);
            part.back = new THREE.Mesh(part.geometry, []);
            part.front.part = part;
            part.lines = ['contours', 'edges'].map((kind) => {
                const geometry = new THREE.BufferGeometry();
                geometry.setAttribute('position', position);
                const lines = new THREE.LineSegments(geometry, this.lineMaterial(kind));
                lines.kind = kind;
                return lines;
            });
            part.group = new THREE.Group();
            part.group.add(part.front, part.back, ...part.lines);
            this.scene.add(part.group);
            part.geometry.computeBoundingBox();
            part.box = part.geometry.boundingBox;
            part.centre = part.box.getCenter(new THREE.Vector3());
            let from = 0;
            part.runs = part.groups.map(([neighbour, patch, count]) => {
                from += count;
                return {neighbour, patch, from: from - count, to: from};
            });
        }
    }

    lineMaterial(kind) {
        this.lineMaterials ??= {
            contours: new THREE.LineBasicMaterial(),
            edges: new THREE.LineBasicMaterial({transparent: true, opacity: 0.35})
        };
        return this.lineMaterials[kind];
    }

    below(id) {
        return this.parts.filter((part) => {
            let node = part.id;
            while (node > id) node = Math.floor(node / 2);
            return node === id;
        });
    }

    scenePoint(point) {
        const {low, step} = this.surface;
        return new THREE.Vector3(...point.map((p, i) => (p - low[i]) / step / this.side - this.middle[i]));
    }

    // A rectangle in each plane, as large as the boxes of the parts that it has divided.
    makeCuts() {
        this.cuts = new THREE.Group();
        const material = new THREE.MeshBasicMaterial(
            {color: 0x3b82d6, transparent: true, opacity: 0.16, side: THREE.DoubleSide, depthWrite: false});
        const rim = new THREE.LineBasicMaterial({color: 0x3b82d6});
        for (const node of this.tree.filter((each) => each.cut?.plane)) {
            const normal = new THREE.Vector3(...node.cut.plane.normal).normalize();
            const point = this.scenePoint(node.cut.plane.point);
            const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
            const back = turn.clone().invert(), box = new THREE.Box3();
            for (const part of this.below(node.id))
                for (let corner = 0; corner < 8; ++corner)
                    box.expandByPoint(new THREE
                                          .Vector3(...['x', 'y', 'z'].map(
                                              (axis, i) => part.box[corner >> i & 1 ? 'max' : 'min'][axis]))
                                          .sub(point)
                                          .applyQuaternion(back));
            const size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3()).setZ(0);
            const plane = new THREE.Mesh(new THREE.PlaneGeometry(size.x, size.y), material);
            plane.quaternion.copy(turn);
            plane.position.copy(middle.applyQuaternion(turn).add(point));
            const outline = new THREE.BufferGeometry();
            outline.setAttribute('position', plane.geometry.getAttribute('position'));
            outline.setIndex([0, 1, 1, 3, 3, 2, 2, 0]);
            plane.add(new THREE.LineSegments(outline, rim));
            plane.node = node.id;
            this.cuts.add(plane);
        }
        this.scene.add(this.cuts);
    }

    // Parts move away from each cut along its normal, less from level to level.
    moveApart(amount) {
        for (const part of this.parts) part.group.position.set(0, 0, 0);
        if (amount === 0) return;
        for (const node of this.tree) {
            const halves = [2 * node.id, 2 * node.id + 1].map((id) => this.below(id));
            if (!this.nodes.has(2 * node.id) || halves.some((half) => half.length === 0)) continue;
            const [a, b] = halves.map(
                (half) =>
                    half.reduce((sum, part) => sum.add(part.centre), new THREE.Vector3()).divideScalar(half.length));
            const way = b.sub(a);
            if (node.cut?.plane) {
                const normal = new THREE.Vector3(...node.cut.plane.normal);
                way.copy(normal.multiplyScalar(normal.dot(way) < 0 ? -1 : 1));
            }
            const level = Math.floor(Math.log2(node.id));
            way.normalize().multiplyScalar(amount * 0.3 * 0.75 ** level);
            halves[0].forEach((part) => part.group.position.sub(way));
            halves[1].forEach((part) => part.group.position.add(way));
        }
    }

    // [lit from outside, plain from inside]: what a clip opens looks as if it were solid.
    materialsOf(colour) {
        if (!this.materials.has(colour)) {
            const vertexColors = colour === byValue, base = vertexColors ? '#ffffff' : colour;
            const common = {vertexColors, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1};
            this.materials.set(colour, [
                new THREE.MeshLambertMaterial({color: base, flatShading: true, ...common}),
                new THREE.MeshBasicMaterial(
                    {color: new THREE.Color(base).multiplyScalar(0.62), side: THREE.BackSide, ...common})
            ]);
        }
        return this.materials.get(colour);
    }

    // state: what the page's controls say; colourOf(part, run): of a run of triangles that have their neighbour and
    // patch in common, or byValue: then the field is shown; isShown(part); ink: of lines.
    show(state, colourOf, isShown, ink, field) {
        Object.values(this.lineMaterials).forEach((material) => material.color.set(ink));
        let drawn = 0;
        for (const part of this.parts) {
            part.group.visible = isShown(part);
            if (field !== undefined)
                part.geometry.setAttribute('color', new THREE.BufferAttribute(part.colours[field], 3, true));
            const seen = part.runs.filter((run) => run.neighbour < 0 ? state.outer : state.interfaces);
            const colours = [...new Set(seen.map((run) => colourOf(part, run)))];
            part.geometry.clearGroups();
            for (const run of seen)
                part.geometry.addGroup(3 * run.from, 3 * (run.to - run.from), colours.indexOf(colourOf(part, run)));
            part.front.material = colours.map((colour) => this.materialsOf(colour)[0]);
            part.back.material = colours.map((colour) => this.materialsOf(colour)[1]);
            if (part.group.visible) drawn += seen.reduce((sum, run) => sum + run.to - run.from, 0);
            this.showLines(part, state, seen);
        }
        this.drawn = drawn;
        this.cuts.visible = state.cuts;
        for (const plane of this.cuts.children) plane.visible = state.branch === 0 || plane.node === state.branch;
        this.moveApart(state.explode);
        this.setClip(state);
        this.draw(state);
    }

    showLines(part, state, seen) {
        for (const lines of part.lines) {
            lines.visible = state[lines.kind];
            const wanted = lines.kind + seen.map((run) => run.from);
            if (!lines.visible || lines.made === wanted) continue;
            lines.made = wanted;
            const neighbours = [...new Set(part.runs.map((run) => run.neighbour))].filter((id) => id >= 0);
            const ends = lines.kind === 'edges' ?
                edgesOf(part.corners, seen.map((run) => [run.from, run.to]), false) :
                neighbours.flatMap(
                    (id) => edgesOf(
                        part.corners, part.runs.filter((run) => run.neighbour === id).map((run) => [run.from, run.to]),
                        true));
            lines.geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(ends), 1));
        }
    }

    setClip(state) {
        const axis = state.axis.slice(-1), sign = state.axis.startsWith('-') ? 1 : -1;
        this.renderer.clippingPlanes = axis ? [this.plane] : [];
        // On an interface the inside of one part and the outside of another are in one place: the inside is seen where
        // a clip has opened the part, else the outside.
        for (const [, inside] of this.materials.values())
            inside.polygonOffsetFactor = inside.polygonOffsetUnits = axis ? 0.5 : 2;
        if (!axis) return;
        const place = this.box.min[axis] + state.clip * (this.box.max[axis] - this.box.min[axis]);
        this.plane.normal.set(0, 0, 0)[axis] = sign;
        this.plane.constant = -sign * place;
    }

    // Where the eye is, and what is right of it and above, for an azimuth and a tilt in degrees.
    directions(angles) {
        const [turn, tilt] = angles.map((degrees) => degrees * Math.PI / 180);
        const eye = new THREE.Vector3(Math.cos(tilt) * Math.cos(turn), Math.cos(tilt) * Math.sin(turn), Math.sin(tilt));
        const right = new THREE.Vector3(-Math.sin(turn), Math.cos(turn), 0);
        return {eye, right, top: new THREE.Vector3().crossVectors(eye, right)};
    }

    // Of a picture in which the box is whole as it is seen at first; turned it may need a smaller zoom.
    halfHeight(ratio) {
        const {right, top} = this.directions(this.firstTurn), high = this.box.max;
        const reach = (way) => Math.abs(way.x) * high.x + Math.abs(way.y) * high.y + Math.abs(way.z) * high.z;
        return Math.max(1.12 * Math.max(reach(top), reach(right) / ratio), 1e-6);
    }

    draw(state) {
        const {clientWidth: width, clientHeight: height} = this.canvas;
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        const {eye, right, top} = this.directions(state.turn), ratio = width / Math.max(height, 1);
        const up = this.halfHeight(ratio) * (1 + 0.6 * state.explode) / state.zoom, across = up * ratio;
        Object.assign(this.camera, {left: -across, right: across, top: up, bottom: -up});
        this.camera.up.set(0, 0, 1);
        const target = right.clone().multiplyScalar(-state.pan[0]).addScaledVector(top, -state.pan[1]);
        this.camera.position.copy(target).addScaledVector(eye, 4);
        this.camera.lookAt(target);
        this.camera.updateProjectionMatrix();
        this.perPixel = 2 * up / Math.max(height, 1);
        this.light.position.copy(eye).addScaledVector(right, -0.5).addScaledVector(top, 0.7);
        this.renderer.render(this.scene, this.camera);
    }

    // The part at a place of the canvas in CSS pixels; null if there is none.
    pick(x, y) {
        const {clientWidth: width, clientHeight: height} = this.canvas;
        const caster = new THREE.Raycaster();
        caster.setFromCamera(new THREE.Vector2(2 * x / width - 1, 1 - 2 * y / height), this.camera);
        const shown = this.parts.filter((part) => part.group.visible);
        const hits = caster.intersectObjects(shown.flatMap((part) => [part.front, part.back]), false);
        const clips = this.renderer.clippingPlanes;
        const hit = hits.find(({point}) => clips.every((plane) => plane.distanceToPoint(point) >= 0));
        return hit ? this.parts.find((part) => part.front === hit.object || part.back === hit.object) : null;
    }

    // The share of pixels on which something is drawn, and a number that another picture does not have.
    check() {
        const gl = this.renderer.getContext(), {drawingBufferWidth: width, drawingBufferHeight: height} = gl;
        const pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        let covered = 0, digest = 2166136261;
        for (let i = 0; i < pixels.length; ++i) {
            digest = Math.imul(digest ^ pixels[i], 16777619);
            if (i % 4 === 3 && pixels[i] > 0) ++covered;
        }
        return {covered: covered / (width * height), digest: (digest >>> 0).toString(16)};
    }
}
