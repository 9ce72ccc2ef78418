// How the page of `taut watch` looks beyond page_style, and how a browser keeps it up to date. Nothing is
// loaded from elsewhere.
#pragma once

namespace taut::host {

inline constexpr const char* live_style = R"(
.status{display:flex;flex-wrap:wrap;gap:.2rem 1.2rem;align-items:baseline;font-variant-numeric:tabular-nums}
.status b{font-size:1.3rem}
.link{padding:.05rem .6rem;border-radius:1rem;background:var(--card);border:1px solid var(--rule)}
.link.lost{background:var(--alarm);color:var(--paper);border-color:var(--alarm)}
.big{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,19rem),1fr));gap:.6rem;margin:.8rem 0}
.big div{background:var(--card);border-radius:6px;padding:.4rem .8rem;min-width:0}
.big span{display:block;color:var(--soft);font-size:1rem;overflow:hidden;text-overflow:ellipsis;white-space:nowrap}
.big strong{font-size:clamp(4.2rem,17vw,7.5rem);line-height:1.05;font-weight:650;letter-spacing:-.03em;white-space:nowrap;
font-variant-numeric:tabular-nums}
.big.many strong{font-size:clamp(3rem,12vw,4.6rem)}
.big small{font-size:1.5rem;color:var(--soft);white-space:nowrap}
.alarms-now{list-style:none;margin:.6rem 0;padding:0}
.alarms-now li{border-left:.5rem solid var(--alarm);background:var(--card);padding:.5rem .8rem;margin:.3rem 0}
.alarms-now li b{font-size:1.6rem}
.alarms-now li.notice{border-color:var(--rule)}
.alarms-now li.notice b{font-size:1rem}
.live-chart{width:100%;height:220px;display:block}
.order{font-size:clamp(1.8rem,6vw,3rem);line-height:1.15;font-weight:650;border-left:.5rem solid var(--one);background:var(--card);padding:.4rem .8rem}
.order[data-order=stop]{border-color:var(--alarm);background:var(--alarm);color:var(--paper)}
.order[data-order=done]{border-color:var(--three)}
.present td{font-weight:650}
.live-chart .stage{stroke:var(--alarm);stroke-dasharray:7 4}
.live-chart .rule{stroke:var(--rule);stroke-width:1}
.live-chart .second{stroke:var(--two)}
.live-chart polyline{stroke-width:2.5}
.live-chart .band{stroke:none}
.forces td:nth-child(2){font-size:1.15rem;font-weight:600}
@media (max-width:40rem){.forces td:nth-child(4),.forces th:nth-child(4){display:none}}
)";

/// Without `<` and `&`, so that the page is XML as well.
inline constexpr const char* live_script = R"(
(function () {
  var data = JSON.parse(document.getElementById('scene').textContent);
  var by = function (id) { return document.getElementById(id); };
  var structure = document.querySelector('.structure');
  var segments = structure.querySelectorAll('.segment'), joints = structure.querySelectorAll('.joint');
  var scale = document.querySelectorAll('.scale text'), scaleName = document.querySelector('.scale span');
  var largest = 0, unit = data.unit, answer = null, drawn = true, history = [];
  function each(list, visit) { Array.prototype.forEach.call(list, visit); }
  // As the report chooses it, and never back to a smaller one.
  function choose(force) {
    if (largest >= force) return;
    largest = force;
    var of = largest >= 2e6 ? ['MN', 1e6] : largest >= 2e3 ? ['kN', 1e3] : ['N', 1];
    var digits = 3 - Math.floor(Math.log10(largest / of[1]));
    unit = { name: of[0], newtons: of[1], decimals: Math.max(1, Math.min(7, digits)) };
  }
  function number(force) { return (force / unit.newtons).toFixed(unit.decimals); }
  function short(value, digits) {
    if (value === 0) return '0';
    return value.toFixed(Math.max(0, Math.min(7, digits - 1 - Math.floor(Math.log10(Math.abs(value))))));
  }
  function half(part) { return short((part.high - part.force) / unit.newtons, 2); }
  function put(node, text) { if (node.textContent !== text) node.textContent = text; }
  function element(name, look, text) {
    var made = document.createElement(name);
    if (look) made.className = look;
    if (text !== undefined) made.textContent = text;
    return made;
  }
  function all() {
    var list = [];
    data.cables.forEach(function (cable) { list = list.concat(answer.segments[cable] || []); });
    return list;
  }
  function showStructure(list) {
    var forces = list.map(function (part) { return part.force; });
    var high = Math.max.apply(null, forces.concat([0]));
    var low = Math.min(Math.min.apply(null, forces), high * (1 - data.span));
    put(scaleName, 'Force [' + unit.name + ']');
    each(scale, function (node, i) { put(node, number(low + i / (scale.length - 1) * (high - low))); });
    each(segments, function (segment, i) {
      var part = (forces[i] - low) / (high - low || 1);
      var colour = Math.max(0, Math.min(data.colours - 1, Math.floor(data.colours * part)));
      segment.querySelector('.cable').setAttribute('class', 'cable c' + colour);
      segment.querySelector('title').textContent = segment.dataset.name + ': ' + number(forces[i]) + ' ' + unit.name +
        ', sd ' + short(list[i].sd / unit.newtons, 2);
      var label = segment.querySelector('text.force');
      if (label) put(label, number(forces[i]));
    });
    var states = [];
    data.cables.forEach(function (cable) { states = states.concat(answer.joints[cable] || []); });
    each(joints, function (joint, j) {
      var path = joint.querySelector('path');
      path.setAttribute('class', states[j].state);
      path.setAttribute('d', data.outlines[states[j].state]);
      joint.querySelector('title').textContent = joint.dataset.name + ': ' + states[j].state;
    });
  }
  function showTables() {
    each(document.querySelectorAll('[data-segment]'), function (row) {
      var part = answer.segments[row.dataset.cable][row.dataset.segment];
      put(row.cells[1], number(part.force) + ' ' + unit.name);
      put(row.cells[2], '\u00b1 ' + half(part));
      put(row.cells[3], number(part.low) + ' \u2013 ' + number(part.high));
    });
    each(document.querySelectorAll('[data-joint]'), function (row) {
      var joint = answer.joints[row.dataset.cable][row.dataset.joint];
      put(row.cells[1], joint.state);
      put(row.cells[2], joint.mu.toFixed(3) + ' \u00b1 ' + short(1.96 * joint.mu_sd, 2));
    });
  }
  function showDigits() {
    each(document.querySelectorAll('[data-jack]'), function (box) {
      var jack = answer.jack[box.dataset.jack];
      put(box.querySelector('strong'), number(jack.force));
      put(box.querySelector('small'), ' ' + unit.name + (jack.stroke === null ? '' : ', ' + (1000 * jack.stroke).toFixed(1) + ' mm'));
    });
    each(document.querySelectorAll('[data-least]'), function (box) {
      var list = answer.segments[box.dataset.least], least = 0;
      list.forEach(function (part, i) { if (list[least].force > part.force) least = i; });
      put(box.querySelector('span'), box.dataset.least + ', least: segment ' + (least + 1));
      put(box.querySelector('strong'), number(list[least].force));
      put(box.querySelector('small'), ' \u00b1 ' + half(list[least]) + ' ' + unit.name);
    });
  }
  function showAlarms() {
    var list = by('alarms'), key = answer.alarms.concat(['|'], answer.notices).join(' ');
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    list.textContent = '';
    function add(word, look) {
      var item = element('li', look), meaning = data.meanings[word.split(':')[0]] || ['', ''];
      item.appendChild(element('b', '', word));
      item.appendChild(element('div', '', meaning[0] + ' ' + meaning[1]));
      list.appendChild(item);
    }
    answer.alarms.forEach(function (word) { add(word, ''); });
    answer.notices.forEach(function (word) { add(word, 'notice'); });
    if (list.children.length === 0) list.appendChild(element('li', 'notice', 'No alarm.'));
  }
  function percent(part) { return (100 * part).toFixed(2) + ' %'; }
  function showPlan() {
    var plan = answer.plan, order = by('order');
    if (!plan) return;
    // The page was loaded before there was an answer: it has no place for a plan yet.
    if (!order) return location.reload();
    put(order, plan.say);
    if (order.dataset.order !== plan.order) order.dataset.order = plan.order;
    put(by('plan-error'), 'at the end ' + percent(plan.error) + ' off target' + (plan.expected === null ? '' :
      ', expected ' + percent(plan.expected) + ', at 95 % ' + percent(plan.at_95)) +
      (plan.planning ? '; a new plan is being looked for' : ''));
    var body = by('stages'), key = JSON.stringify([plan.stages, plan.anew]);
    if (body.dataset.key === key) return;
    body.dataset.key = key;
    body.textContent = '';
    plan.stages.forEach(function (stage) {
      var row = element('tr', stage.state === 'present' ? 'present' : '');
      row.appendChild(element('td', 'text', stage.say));
      row.appendChild(element('td', 'short', stage.state));
      body.appendChild(row);
    });
    by('anew').textContent = '';
    plan.anew.forEach(function (each) { by('anew').appendChild(element('li', '', each.say)); });
  }
  function stageOf(jack) {
    var order = answer.plan ? answer.plan.jacks[jack] : null;
    return order ? order.to : null;
  }
  // Charts: pixels of the page, so that text keeps its size.
  var svg = 'http://www.w3.org/2000/svg';
  function draw(node, lines, range, xs, labels, band) {
    var width = node.clientWidth || 640, height = 220, left = 64, right = 10, top = 12, bottom = 26;
    var x = function (v) { return left + (v - xs[0]) / (xs[1] - xs[0] || 1) * (width - left - right); };
    var y = function (v) { return height - bottom - (v - range[0]) / (range[1] - range[0] || 1) * (height - top - bottom); };
    node.textContent = '';
    node.setAttribute('viewBox', '0 0 ' + width + ' ' + height);
    function add(name, attributes, text) {
      var made = document.createElementNS(svg, name);
      Object.keys(attributes).forEach(function (key) { made.setAttribute(key, attributes[key]); });
      if (text !== undefined) made.textContent = text;
      node.appendChild(made);
    }
    for (var i = 0; i !== 5; ++i) {
      var v = range[0] + i / 4 * (range[1] - range[0]);
      add('line', { 'class': 'rule', x1: left, x2: width - right, y1: y(v), y2: y(v) });
      add('text', { x: left - 6, y: y(v) + 4, 'text-anchor': 'end' }, labels.y(v));
    }
    labels.at.forEach(function (at) {
      var anchor = at === xs[0] ? 'start' : at === xs[1] ? 'end' : 'middle';
      add('text', { x: x(at), y: height - 6, 'text-anchor': anchor }, labels.x(at));
    });
    function points(list) { return list.map(function (p) { return x(p[0]).toFixed(1) + ',' + y(p[1]).toFixed(1); }).join(' '); }
    if (band) add('polygon', { 'class': 'band', points: points(band) });
    lines.forEach(function (line) { add('polyline', { 'class': line.look, points: points(line.points) }); });
  }
  function around(values, least) {
    var low = Math.min.apply(null, values), high = Math.max.apply(null, values);
    var more = Math.max(0.06 * (high - low), least * Math.abs(high), 1e-9);
    return [low - more, high + more];
  }
  function showAlong() {
    data.cables.forEach(function (cable, c) {
      var list = answer.segments[cable], low = [], high = [], line = [], values = [];
      list.forEach(function (part, i) {
        line.push([i, part.force], [i + 1, part.force]);
        low.push([i, part.low], [i + 1, part.low]);
        high.push([i, part.high], [i + 1, part.high]);
        values.push(part.low, part.high);
      });
      var lines = [{ look: 'estimate', points: line }];
      (data.targets[c] || []).forEach(function (target, i) {
        if (target === null) return;
        lines.push({ look: 'target', points: [[i, target], [i + 1, target]] });
        values.push(target);
      });
      data.limits[c].forEach(function (limit) {
        if (limit === null) return;
        lines.push({ look: 'limit', points: [[0, limit], [list.length, limit]] });
        values.push(limit);
      });
      var every = Math.ceil(list.length / 8), middles = [];
      for (var m = 0; list.length > m; m += every) middles.push(m + 0.5);
      draw(by('along' + c), lines, around(values, 0.01), [0, list.length],
        { y: number, at: middles, x: function (v) { return 'T' + Math.round(v + 0.5); } }, high.concat(low.reverse()));
    });
  }
  function clock(t) { return short(t, 4) + ' s'; }
  function showHistory() {
    if (history.length === 0) return;
    var xs = [history[0][0], history[history.length - 1][0]];
    data.jacks.forEach(function (jack, j) {
      ['load', 'stroke'].forEach(function (what, k) {
        var points = [];
        history.forEach(function (p) { if (p[1][j][k] !== null) points.push([p[0], p[1][j][k]]); });
        if (points.length === 0) return;
        var lines = [{ look: k ? 'second' : 'estimate', points: points }], stage = k ? null : stageOf(jack);
        var values = points.map(function (p) { return p[1]; });
        if (stage !== null) {
          lines.push({ look: 'stage', points: [[xs[0], stage], [xs[1], stage]] });
          values.push(stage);
        }
        draw(by(what + j), lines, around(values, k ? 0.001 : 0.02), xs,
          { y: k ? function (v) { return (1000 * v).toFixed(1); } : number, x: clock, at: [0, 1, 2, 3].map(function (i) {
            return i === 3 ? xs[1] : xs[0] + i / 3 * (xs[1] - xs[0]);
          }) });
        if (k) put(by('unit-stroke' + j), 'Stroke [mm]'); else put(by('unit-load' + j), 'Load [' + unit.name + ']');
      });
    });
  }
  function remember() {
    if (answer.time === null) return;
    var last = history[history.length - 1];
    if (last) if (last[0] === answer.time) return;
    history.push([answer.time, data.jacks.map(function (jack) { return [answer.jack[jack].force, answer.jack[jack].stroke]; }), 0]);
    if (history.length > 2400) history = history.filter(function (p, i) { return i % 2 === 0; });
  }
  var charted = 0;
  function show() {
    drawn = true;
    showAlarms();
    showPlan();
    if (answer.time === null) return;
    put(by('time'), Math.round(1000 * answer.time) / 1000 + ' s');
    var list = all();
    list.forEach(function (part) { choose(part.force); });
    showDigits();
    showStructure(list);
    showTables();
    if (Date.now() - charted >= 200 || charted === 0) {
      charted = Date.now();
      showAlong();
      showHistory();
    } else {
      late();
    }
  }
  var waits = false;
  function late() {
    if (waits) return;
    waits = true;
    setTimeout(function () { waits = false; charted = Date.now(); showAlong(); showHistory(); }, 200);
  }
  function take(text) {
    var next = JSON.parse(text);
    answer = next;
    remember();
    if (!drawn) return;
    drawn = false;
    requestAnimationFrame(show);
  }
  function link(good) {
    by('link').className = good ? 'link' : 'link lost';
    put(by('link'), good ? 'live' : 'no connection to taut');
  }
  // A worker listens, so that whoever waits until nothing is loading any more, such as a printing browser, comes to an end.
  function listen() {
    var source = 'var e = new EventSource("' + location.origin + '/events");' +
      'e.onmessage = function (m) { postMessage(m.data); };' +
      'e.onopen = function () { postMessage("+"); }; e.onerror = function () { postMessage("-"); };';
    var worker = new Worker(URL.createObjectURL(new Blob([source], { type: 'text/javascript' })));
    worker.onmessage = function (message) {
      if (message.data === '+' || message.data === '-') return link(message.data === '+');
      link(true);
      take(message.data);
    };
  }
  var request = new XMLHttpRequest();
  request.open('GET', '/history.json');
  request.onload = function () {
    try { history = JSON.parse(request.responseText); } catch (error) { history = []; }
    var first = document.getElementById('answer').textContent;
    if (first !== 'null') take(first);
    listen();
  };
  request.onerror = function () { link(false); };
  request.send();
  window.addEventListener('resize', function () { if (answer) if (answer.time !== null) late(); });
})();
)";

}  // namespace taut::host
