// SPDX-License-Identifier: Apache-2.0
// What moves on the page of a run (page.html). The constant "data" is the block of JSON that page.c writes.
const colours = ["#6cb6ff", "#f5a65b", "#7fdca0", "#c99bff", "#ff8fa3", "#e8d56b", "#5fd3d3", "#b9c3d0"];
const states = ["waiting", "running", "holding", "safe", "fault", "frozen", "pattern"];
const by = id => document.getElementById(id);
const put = (parent, tag, text, attributes) => {
  const svg = parent.namespaceURI.endsWith("svg");
  const element = svg ? document.createElementNS(parent.namespaceURI, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) element.setAttribute(name, value);
  if (text !== null && text !== undefined) element.textContent = text;
  return parent.appendChild(element);
};
const number = (value, decimals) => value === null ? "–" : value.toFixed(decimals);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

const duration = data.frames.length ? data.frames[data.frames.length - 1].t + 0.5 / data.rate_hz : 0;

/* The top: title and the four figures one asks for first. */
function fillTop() {
  const walls = data.boards.length, judged = data.boards.filter(b => b.db[0] !== null);
  by("title").textContent = (["", "One projector", "Two projectors", "Three projectors", "Four projectors"][walls] || walls + " projectors") + ", one viewer, one undistorted picture";
  const gap = judged.reduce((sum, b) => sum + b.db[1] - b.db[0], 0) / judged.length;
  const slowest = Math.max(...data.boards.map(b => b.ms[0]));
  const tile = (figure, text) => { const t = put(by("tiles"), "div", null, {class: "tile card"}); put(t, "b", figure); put(t, "span", text); };
  tile(data.count + " frames", duration.toFixed(1) + " s " + (data.real ? "in real time" : "at " + data.rate_hz + " Hz, in virtual time") +
    ", on " + walls + (walls === 1 ? " board" : " boards"));
  tile(judged.length ? gap.toFixed(2) + " dB" : "not judged", "mean distance from the best that any method can show on these walls");
  tile(data.bus.load.toFixed(1) + " %", "mean load of one " + (data.bus.fd ? "CAN FD" : "classic CAN") + " bus at " + data.bus.bitrate / 1000 + " kbit/s");
  tile(slowest.toFixed(1) + " ms", "a frame on the slowest board, on one core of this machine");
}

/* Pictures are decoded before they are put in their places, so that all of them change together. */
const cache = new Map();
function picture(name, n) {
  const file = encodeURIComponent(name) + "_" + String(n).padStart(5, "0") + ".png";
  let image = cache.get(file);
  if (!image) {
    image = new Image();
    image.src = file;
    image.alt = name;
    cache.set(file, image);
    if (cache.size > 60 * (data.boards.length + 2)) cache.delete(cache.keys().next().value);
  }
  return image;
}
const decoded = image => image && image.decode().catch(() => null);
const place = (view, image) => view.replaceChildren(image || "no pose yet");

/* What turns camera vectors into world vectors. */
function turned(q, v) {
  const u = q.slice(1), t = cross(u, v).map(x => 2 * x), s = cross(u, t);
  return v.map((x, i) => x + q[0] * t[i] + s[i]);
}
/* The plan's axes: the viewer's mean up and mean view, each taken to the nearest axis of the world. */
function nearestAxis(vectors, without) {
  const sum = [0, 1, 2].map(i => i === without ? 0 : vectors.reduce((s, v) => s + v[i], 0));
  const i = sum.map(Math.abs).indexOf(Math.max(...sum.map(Math.abs)));
  return [0, 1, 2].map(j => j === i ? Math.sign(sum[i]) || 1 : 0);
}
const eyes = data.frames.filter(f => f.eye);
const up = nearestAxis(eyes.map(f => turned(f.eye.slice(3), [0, -1, 0])).concat(eyes.length ? [] : [[0, -1, 0]]), -1);
const ahead = nearestAxis(eyes.map(f => turned(f.eye.slice(3), [0, 0, 1])).concat(eyes.length ? [] : [[0, 0, 1]]), up.findIndex(x => x));
const right = cross(ahead, up);
const flat = p => [dot(p, right), -dot(p, ahead)];
let viewer = null;
function fillPlan() {
  const svg = by("plan"), points = data.boards.flatMap(b => b.corners_mm.map(flat)).concat(eyes.map(f => flat(f.eye)));
  const low = [0, 1].map(i => Math.min(...points.map(p => p[i]))), high = [0, 1].map(i => Math.max(...points.map(p => p[i])));
  const size = Math.max(high[0] - low[0], high[1] - low[1]), edge = size * 0.09, text = size * 0.034;
  svg.setAttribute("viewBox", [low[0] - edge, low[1] - edge, high[0] - low[0] + 2 * edge, high[1] - low[1] + 2.1 * edge].join(" "));
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  data.boards.forEach((b, i) => {
    const c = b.corners_mm.map(flat), colour = colours[i % 8];
    const area = Math.abs(c.reduce((s, p, j) => s + p[0] * c[(j + 1) % 4][1] - p[1] * c[(j + 1) % 4][0], 0)) / 2;
    const standing = area < 0.03 * size * size;
    const mean = [0, 1].map(k => c.reduce((s, p) => s + p[k], 0) / 4);
    put(svg, "polygon", null, {points: c.map(p => p.join()).join(" "), fill: standing ? "none" : colour, "fill-opacity": 0.09, stroke: colour,
      "stroke-width": size * (standing ? 0.013 : 0.003), "stroke-linejoin": "round", "stroke-dasharray": standing ? "none" : size * 0.015});
    const away = [mean[0] - middle[0], mean[1] - middle[1]], far = Math.hypot(...away);
    const out = standing && far > 0 ? away.map(x => x / far * text * 1.5) : [0, 0];
    const side = standing && Math.abs(out[0]) > Math.abs(out[1]);
    const at = standing ? [mean[0] + out[0], mean[1] + out[1]] : [high[0] - text * 2.2, c.reduce((s, p) => Math.max(s, p[1]), -1e9) - text];
    put(svg, "text", b.name, {x: at[0], y: at[1] + text * 0.35, fill: colour, "font-size": text, "text-anchor": "middle",
      transform: side ? "rotate(" + (out[0] < 0 ? -90 : 90) + " " + at.join(" ") + ")" : ""});
  });
  put(svg, "polyline", null, {points: eyes.map(f => flat(f.eye).join()).join(" "), fill: "none", stroke: "#dbe3ee", "stroke-opacity": 0.4, "stroke-width": size * 0.006, "stroke-linecap": "round"});
  viewer = put(svg, "g", null, {});
  const half = Math.atan(data.camera.width / 2 / data.camera.focal_px[0]), reach = size * 0.3;
  put(viewer, "path", null, {d: `M0 0 L${-Math.sin(half) * reach} ${-Math.cos(half) * reach} A${reach} ${reach} 0 0 1 ${Math.sin(half) * reach} ${-Math.cos(half) * reach} Z`, fill: "#fff", "fill-opacity": 0.13});
  put(viewer, "circle", null, {r: size * 0.022, fill: "#fff"});
  const metre = put(svg, "g", null, {transform: `translate(${low[0]} ${high[1] + edge * 0.72})`});
  put(metre, "path", null, {d: "M0 0 H1000", stroke: "#8d9bb0", "stroke-width": size * 0.004});
  put(metre, "text", "1 m", {x: 1000 + text * 0.5, y: text * 0.35, fill: "#8d9bb0", "font-size": text});
}

const panels = [];
function fillWalls() {
  data.boards.forEach((b, i) => {
    const figure = put(by("walls"), "figure", null, {class: "card"});
    const view = put(figure, "div", null, {class: "view"});
    const caption = put(figure, "figcaption");
    put(caption, "i", null, {class: "mark", style: "background:" + colours[i % 8]});
    put(caption, "span", b.name);
    panels.push({view, state: put(caption, "span", "", {class: "pill"}), figures: put(caption, "small")});
  });
}

/* One frame in every panel. A newer call makes an older one that still decodes stop. */
let shown = -1, wanted = 0;
async function show(index) {
  wanted = index;
  const f = data.frames[index];
  const images = ["viewer", "uncompensated"].map(name => f.eye ? picture(name, f.n) : null).concat(data.boards.map(b => picture(b.name, f.n)));
  if (shown >= 0) await Promise.all(images.map(decoded));
  if (wanted !== index) return;
  place(by("with"), images[0]);
  place(by("without"), images[1]);
  data.boards.forEach((b, i) => {
    const [state, k, lit] = b.frames[index];
    place(panels[i].view, images[i + 2]);
    panels[i].state.textContent = states[state];
    panels[i].state.style.cssText = state === 1 ? "background:#16382a;color:#7fdca0" : state === 4 ? "background:#472027;color:#ff8fa3" : "";
    panels[i].figures.textContent = lit > 0 ? "k " + k.toFixed(2) + " · lit " + (100 * lit).toFixed(0) + " %" : "out of view";
  });
  if (f.eye) {
    const p = flat(f.eye), look = flat(turned(f.eye.slice(3), [0, 0, 1]));
    viewer.setAttribute("transform", `translate(${p.join()}) rotate(${Math.atan2(look[0], -look[1]) * 180 / Math.PI})`);
  }
  viewer.setAttribute("visibility", f.eye ? "visible" : "hidden");
  by("slider").value = index;
  by("clock").textContent = f.t.toFixed(2) + " s · frame " + (f.n + 1) + " of " + data.count;
  shown = index;
}

let playing = false, busy = false, since = 0, from = 0;
function tick(now) {
  if (!playing) return;
  const period = duration * 1000 / data.frames.length;
  const index = (from + Math.floor((now - since) / period)) % data.frames.length;
  if (!busy && index !== shown) {
    busy = true;
    show(index).finally(() => { busy = false; });
  }
  requestAnimationFrame(tick);
}
function play(on) {
  playing = on && data.frames.length > 1;
  by("play").textContent = playing ? "Pause" : "Play";
  since = performance.now();
  from = Math.max(shown, 0);
  if (playing) requestAnimationFrame(tick);
}

/* Five plots in rows of two and three, four in rows of two, three in a row. */
function fillPlots() {
  const judged = data.boards.some(b => b.judged), original = judged && data.original !== null;
  const add = (file, text, wide) => {
    const card = put(by("plots"), "div", null, {class: wide ? "card wide" : "card"});
    put(card, "img", null, {src: file, alt: text}).onerror = () => card.remove();
  };
  if (judged) add("psnr.svg", "PSNR of judged frames and its limit, against the picture", true);
  if (original) add("psnr_original.svg", "The same against the finer original", true);
  add("step.svg", "Step k of each board", judged && !original);
  add("time.svg", "Time of a step on each board", judged && !original);
  add("bus.svg", "Bus load", judged && !original);
}

function fillTable() {
  const head = ["board", "node", "panel, px", "method", "step k", "lit", "PSNR / limit", "vs original / limit", "ms a frame", "worst ms", "pose to photon, ms", "off plane, mm"];
  const row = put(by("boards"), "tr");
  head.forEach(text => put(row, "th", text));
  data.boards.forEach(b => {
    const cells = put(by("boards"), "tr");
    const pair = i => b.db[i] === null ? "–" : number(b.db[i], 2) + " / " + number(b.db[i + 1], 2);
    [b.name, b.node, b.width + " × " + b.height, b.method, b.k ? b.k[0].toFixed(2) + " – " + b.k[1].toFixed(2) : "–", (100 * b.lit).toFixed(0) + " %",
      pair(0), pair(2), b.ms[0].toFixed(1), b.ms[1].toFixed(1), b.late_ms === null ? "–" : b.late_ms.toFixed(1), b.plane_mm[1].toFixed(1)].forEach(text => put(cells, "td", text));
  });
}

function fillLists() {
  const fill = (id, rows) => rows.forEach(([name, value]) => { put(by(id), "dt", name); put(by(id), "dd", value); });
  const pose = data.real ? "" : data.bus.fd ? ", a pose is one frame of 32 bytes" : ", a pose is a set of three frames";
  fill("bus", [["Kind", (data.bus.fd ? "CAN FD" : "Classic CAN") + pose],
    ["Bit rate", data.bus.bitrate / 1000 + " kbit/s" + (data.bus.fd ? ", data " + data.bus.data_bitrate / 1000 + " kbit/s" : "")],
    ["Frames on the wire", data.bus.frames], ["Poses sent by the tracker", data.real ? "by a client on the port" : data.bus.poses],
    ["Mean load", data.bus.load.toFixed(2) + " %"], ["Highest load from frame to frame", data.bus.peak.toFixed(2) + " %"], ["Error frames", data.bus.errors],
    ["Walls proved in step", data.agreement.in_step + " of " + data.agreement.walls + ", different " + data.agreement.differing],
    ["Pose to photon", data.agreement.in_step ? data.agreement.latency_ms.toFixed(1) + " ms, at most " + data.agreement.latency_most_ms.toFixed(1) + " ms" : "not known"]]);
  fill("settings", [["Room", data.room], ["Video", data.video], ["Poses", data.poses || "from the bus"], ["Finer original", data.original || "none"],
    ["Viewer's camera", data.camera.width + " × " + data.camera.height + " px, " + (2 * Math.atan(data.camera.width / 2 / data.camera.focal_px[0]) * 180 / Math.PI).toFixed(0) + "° wide"],
    ["Refresh", data.rate_hz + " Hz" + (data.real ? ", " + data.skipped + " skipped" : "")], ["Judged frames", Math.max(...data.boards.map(b => b.judged))]]);
}

document.documentElement.style.setProperty("--shape", data.camera.width + " / " + data.camera.height);
fillTop(); fillPlan(); fillWalls(); fillPlots(); fillTable(); fillLists();
by("slider").max = Math.max(data.frames.length - 1, 0);
by("slider").oninput = event => { play(false); show(Number(event.target.value)); };
by("play").onclick = () => play(!playing);
if (data.frames.length) {
  const first = data.frames.findIndex(f => f.eye);
  show(first < 0 ? 0 : Math.min(data.frames.length - 1, Math.max(first, Math.floor(data.frames.length * 0.3)))).then(() => play(!matchMedia("(prefers-reduced-motion: reduce)").matches));
}
