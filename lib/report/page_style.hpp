// How a report looks, and what a browser with JavaScript adds to it. Nothing is loaded from elsewhere.
#pragma once

namespace taut::host {

/// Style rules but for the colours of forces. Classes of curves: `estimate`, `nominal`, `reading`, `line-1`
/// to `line-3`, `other`, `prior`; of bands `band` and `band-1` to `band-3`; states and alarms have their own
/// colours.
inline constexpr const char* page_style = R"(
:root{color-scheme:light dark;--paper:#ffffff;--card:#f6f7f9;--ink:#1b1f24;--soft:#555d68;--rule:#d5d9df;
--one:#0072b2;--two:#c24e00;--three:#00735a;--other:#b4bac3;--reading:#7a828d;--alarm:#b0005a;
--stick:#b9bfc8;--forward:#0072b2;--backward:#d55e00;--open:#1b1f24;--strut:#8a919b}
@media screen and (prefers-color-scheme:dark){:root{--paper:#14171b;--card:#1d2126;--ink:#eceff3;--soft:#aab2bd;
--rule:#363c45;--one:#56b4e9;--two:#ff9d5c;--three:#3fcaa5;--other:#5b636e;--reading:#98a1ad;--alarm:#ff7fbe;
--stick:#59616c;--forward:#3d9fdb;--backward:#ef8333;--open:#eceff3;--strut:#87909c}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:64rem;padding:1rem clamp(.75rem,3vw,2rem) 3rem;background:var(--paper);color:var(--ink);
font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif;overflow-wrap:break-word}
h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0 .25rem}
h2{font-size:1.2rem;margin:2.25rem 0 .5rem;border-bottom:1px solid var(--rule);padding-bottom:.2rem}
h3{font-size:1rem;margin:1.25rem 0 .25rem}
p{margin:.4rem 0}
.files,.note,.x-title,.y-title,.legend,.scale span{color:var(--soft);font-size:.875rem}
.summary{font-size:1.05rem}
.warning{border-left:4px solid var(--alarm);background:var(--card);padding:.6rem .8rem}
figure{margin:.5rem 0 1rem;break-inside:avoid}
.legend{list-style:none;display:flex;flex-wrap:wrap;gap:.15rem 1.1rem;margin:.3rem 0;padding:0}
.legend li{display:flex;align-items:center;gap:.4rem}
.sample{flex:none}
.patch{width:1.4rem;height:.8rem;flex:none}
.plot{padding:16px 10px 24px 60px}
svg{display:block;overflow:visible}
svg text.lean,svg text.force{font-size:10px}
svg text.force{fill:var(--ink)}
svg text.node{font-size:9px}
svg text{font-size:12px;fill:var(--soft);stroke:none;font-variant-numeric:tabular-nums}
.x-title{text-align:right;padding-right:10px;margin-top:-2px}
.grid line{stroke:var(--rule);stroke-width:1}
polyline,.sample line{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round;vector-effect:non-scaling-stroke}
.estimate,.line-1{stroke:var(--one)}
.line-2{stroke:var(--two);stroke-dasharray:9 4}
.line-3{stroke:var(--three);stroke-dasharray:2 4}
.nominal{stroke:var(--two);stroke-dasharray:7 4}
.target{stroke:var(--three)}
.limit{stroke:var(--alarm);stroke-dasharray:12 4}
.cursor{stroke:var(--ink);stroke-width:1;pointer-events:none}
.moved .at-end,.moved .nominal,.moved .at{visibility:hidden}
.prior{stroke:var(--ink);stroke-dasharray:2 5}
.other{stroke:var(--other)}
.reading{stroke:var(--reading)}
.first{stroke-dasharray:4 3}
polyline.prior,polyline.other,polyline.reading{stroke-width:1}
polygon{stroke:none;opacity:.22}
.band,.band-1{fill:var(--one)}
.band-2{fill:var(--two)}
.band-3{fill:var(--three)}
.sample .band{stroke:var(--one);stroke-width:11;stroke-linecap:butt;opacity:.22}
path.measured{fill:var(--paper);stroke:var(--ink);stroke-width:2}
.sample .measured{stroke:var(--ink);stroke-width:9;stroke-dasharray:9 99;stroke-dashoffset:-8.5;stroke-linecap:butt;transform:rotate(45deg);
transform-origin:14px 6px}
.alarm{fill:var(--alarm)}
.sample .alarm{stroke:var(--alarm);stroke-width:8;stroke-linecap:butt}
.states path{shape-rendering:crispEdges}
.stick{fill:var(--stick);background:var(--stick)}
.forward{fill:var(--forward);background:var(--forward)}
.backward{fill:var(--backward);background:var(--backward)}
.open{fill:var(--open);background:var(--open)}
.structure{width:100%;height:auto;background:var(--card);border-radius:6px}
.structure line,.sample .strut{vector-effect:non-scaling-stroke;stroke-linecap:round}
.structure .hit{stroke:transparent;stroke-width:16}
.structure .strut,.sample .strut{stroke:var(--strut);stroke-width:1.5}
.structure .beam,.sample .beam{stroke:var(--strut);stroke-width:6}
.hinge{fill:var(--paper);stroke:var(--strut);stroke-width:1.5}
.structure .tension,.sample .tension{stroke-dasharray:5 4}
.structure .casing{stroke:var(--ink);stroke-width:7}
.structure .cable{stroke:var(--c,var(--paper));stroke-width:4.5}
.segment:hover .casing{stroke-width:11}
.support{fill:none;stroke:var(--soft);stroke-width:1.5}
.substructure{fill:none;stroke:var(--soft);stroke-width:1.5;stroke-dasharray:3 2}
.jack{fill:var(--ink)}
.joint path{stroke:var(--ink);stroke-width:1.3}
.joint .open{fill:var(--paper);stroke-width:2.6}
.axes line{stroke:var(--soft);stroke-width:1.5}
.scale{display:grid;grid-template-columns:auto 1fr;gap:0 .9rem;padding:.6rem 10px 1.6rem 0}
.scale rect{fill:var(--c);shape-rendering:crispEdges}
.player{display:flex;flex-wrap:wrap;gap:.3rem .8rem;align-items:center}
.player[hidden]{display:none}
.player input{flex:1 1 14rem;min-width:8rem;accent-color:var(--one)}
.player output{min-width:7.5rem;font-variant-numeric:tabular-nums}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums;min-width:100%}
caption{text-align:left;color:var(--soft)}
th,td{padding:.3rem .6rem;border-bottom:1px solid var(--rule);text-align:left;vertical-align:top}
th{font-weight:600}
.number{text-align:right;white-space:nowrap}
.short{white-space:nowrap}
td.text{min-width:11rem}
.name{min-width:8rem;overflow-wrap:break-word}
@media (max-width:40rem){th,td{padding:.3rem .4rem}
.alarms thead{display:none}.alarms tr{display:block;padding:.4rem 0;border-bottom:1px solid var(--rule)}
.alarms td{display:inline-block;border:0;padding:.1rem .8rem .1rem 0;white-space:normal;text-align:left}
.alarms td.text{display:block}.alarms td[data-name]::before{content:attr(data-name) " "}}
.record{margin-bottom:2.5rem}
.record h2{margin:1.1rem 0 .3rem;font-size:1.05rem}
.record td,.record th{padding:.2rem .5rem}
.record code{font-size:.75rem;overflow-wrap:anywhere}
.entries{display:grid;grid-template-columns:repeat(auto-fit,minmax(17rem,1fr));gap:.1rem 1.5rem;margin:.5rem 0}
.entry{border-bottom:1px solid var(--rule);min-height:1.7rem}
.fails td{color:var(--alarm);font-weight:600}
.signatures{display:grid;grid-template-columns:repeat(3,1fr);gap:1.5rem;margin-top:1.2rem;break-inside:avoid}
.signature{border-bottom:1px solid var(--ink);min-height:4.2rem;display:flex;flex-direction:column;justify-content:space-between}
@page{size:A4;margin:13mm 14mm 15mm;@bottom-right{content:counter(page) " / " counter(pages);font:8pt sans-serif}}
@media print{.together,.run{break-inside:avoid}.record{margin:0 0 8mm;font-size:9pt;line-height:1.3}
.record h1{font-size:16pt;margin:0 0 1mm}.record h2{font-size:10.5pt;margin:2.5mm 0 .5mm}
.record .entries{grid-template-columns:1fr 1fr;margin:1mm 0}.record .entry{min-height:5.5mm}
.record table{font-size:8pt}.record td,.record th{padding:.5mm 1.2mm}.record .short,.record .number{white-space:nowrap}
.record th.number,.record th.short{white-space:normal}.name{min-width:0}
.record tbody tr:nth-child(-n+2),.record tbody tr:nth-last-child(2){break-after:avoid}
.record .note,.record .files{font-size:7.5pt;line-height:1.25}.record code{font-size:7pt}.record p{margin:.5mm 0}
.record .signature{min-height:17mm}.record ul{margin:.5mm 0 0}}
@media print{body{max-width:none;padding:0;font-size:11pt}.player{display:none}h2,h3{break-after:avoid}tr{break-inside:avoid}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}.wide{overflow:visible}
table{font-size:8.5pt}th,td{padding:.15rem .3rem}td.text{min-width:0}.number,.short{white-space:normal}
h2{margin:4mm 0 1mm}figure{margin:1mm 0 2mm}.chart{zoom:.75}section{break-inside:auto}}
)";

/// Moves the drawing of the structure, all charts and the tables of values through time. Without `<` and `&`,
/// so that the page is XML as well.
inline constexpr const char* page_script = R"(
(function () {
  var data = JSON.parse(document.getElementById('frames').textContent);
  var player = document.getElementById('player');
  var slider = player.querySelector('input'), shown = player.querySelector('output');
  var structure = document.querySelector('.structure');
  var segments = structure.querySelectorAll('.segment'), joints = structure.querySelectorAll('.joint');
  var numbers = document.querySelectorAll('.scale text');
  var figures = document.querySelectorAll('figure.along'), tables = document.querySelectorAll('.values tbody');
  var whens = document.querySelectorAll('.when'), last = data.frames.length - 1;
  var cursors = Array.prototype.map.call(document.querySelectorAll('figure.over-time .plot'), function (plot) {
    var svg = plot.querySelector('svg'), line = document.createElementNS(svg.namespaceURI, 'line');
    line.setAttribute('class', 'cursor');
    line.setAttribute('y1', 0);
    line.setAttribute('y2', '100%');
    line.style.display = 'none';
    return svg.appendChild(line);
  });
  function digits(number) { return number ? Number(number).toPrecision(2).replace(/e.*/, '') : '0'; }
  function draw(figure, frame) {
    var first = Number(figure.dataset.first), low = Number(figure.dataset.low), high = Number(figure.dataset.high);
    var svg = figure.querySelector('.stretched'), line = svg.querySelector('polyline.estimate');
    var count = line.dataset.count = line.dataset.count || line.getAttribute('points').split(' ').length / 2;
    var box = svg.viewBox.baseVal, end = data.frames[last], upper = [], lower = [], middle = [];
    var scale = Math.max.apply(null, frame[1].slice(first, first + Number(count))) /
      (Math.max.apply(null, end[1].slice(first, first + Number(count))) || 1);
    if (!(scale - 0.02 >= 0)) scale = 0.02;
    if (frame === end) scale = 1;
    function y(force) {
      var part = (force / scale - low) / (high - low || 1);
      return (box.height * (1 - Math.min(1, Math.max(0, part)))).toFixed(1);
    }
    for (var i = 0; count - i > 0; ++i) {
      var force = frame[1][first + i], half = data.band * frame[4][first + i];
      [i, i + 1].forEach(function (k) {
        var x = (box.width * k / count).toFixed(1) + ',';
        middle.push(x + y(force));
        upper.push(x + y(force + half));
        lower.unshift(x + y(Math.max(force - half, 0)));
      });
    }
    line.setAttribute('points', middle.join(' '));
    svg.querySelector('polygon.band').setAttribute('points', upper.concat(lower).join(' '));
    figure.querySelectorAll('.plot g.grid')[0].querySelectorAll('text').forEach(function (text) {
      text.dataset.end = text.dataset.end || text.textContent;
      text.textContent = scale === 1 ? text.dataset.end : (Number(text.dataset.end) * scale).toPrecision(3);
    });
    svg.querySelectorAll('.target, .limit').forEach(function (other) {
      other.style.visibility = scale === 1 ? '' : 'hidden';
    });
  }
  function fill(rows, frame, first, joint) {
    rows.forEach(function (row, i) {
      function put(name, text) {
        var cell = row.querySelector('.' + name);
        if (cell) cell.textContent = text;
      }
      put('force', frame[1][first + i].toFixed(data.decimals));
      put('sd', digits(frame[4][first + i]));
      if (!row.querySelector('.mu')) return;
      var j = joint + i;
      put('state', data.states[frame[2].charAt(j)][2]);
      put('mu', frame[5][j].toFixed(4));
      put('mu-sd', digits(frame[6][j]));
      put('contact', frame[7][j].toFixed(data.decimals));
      put('used', (100 * frame[8][j]).toFixed(0) + ' %');
    });
  }
  function show(frame) {
    var is_end = frame === data.frames[last], first = 0, joint = 0;
    document.body.classList.toggle('moved', !is_end);
    whens.forEach(function (when) { when.textContent = is_end ? data.end : data.at.replace('{1}', frame[0]); });
    cursors.forEach(function (line) {
      line.style.display = is_end ? 'none' : '';
      line.setAttribute('x1', 100 * frame[3] + '%');
      line.setAttribute('x2', 100 * frame[3] + '%');
    });
    figures.forEach(function (figure) { draw(figure, frame); });
    tables.forEach(function (table) {
      var rows = table.querySelectorAll('tr');
      fill(rows, frame, first, joint);
      first += rows.length;
      joint += table.querySelectorAll('.mu').length;
    });
    shown.textContent = frame[0] + ' s';
    slider.setAttribute('aria-valuetext', frame[0] + ' s');
    var high = Math.max.apply(null, frame[1]);
    var low = Math.min(Math.min.apply(null, frame[1]), high * (1 - data.span));
    numbers.forEach(function (number, i) {
      number.textContent = (low + i / (numbers.length - 1) * (high - low)).toFixed(data.decimals);
    });
    segments.forEach(function (segment, i) {
      var part = (frame[1][i] - low) / (high - low || 1);
      var colour = Math.max(0, Math.min(data.colours - 1, Math.floor(data.colours * part)));
      segment.querySelector('.cable').setAttribute('class', 'cable c' + colour);
      segment.querySelector('title').textContent =
        segment.dataset.name + ': ' + frame[1][i].toFixed(data.decimals) + ' ' + data.unit;
      var label = segment.querySelector('text.force');
      if (label) label.textContent = frame[1][i].toFixed(data.decimals);
    });
    joints.forEach(function (joint, j) {
      var state = data.states[frame[2].charAt(j)];
      joint.querySelector('path').setAttribute('class', state[0]);
      joint.querySelector('path').setAttribute('d', state[1]);
      joint.querySelector('title').textContent = joint.dataset.name + ': ' + state[2];
    });
  }
  slider.max = slider.value = data.frames.length - 1;
  slider.addEventListener('input', function () { show(data.frames[slider.value]); });
  shown.textContent = data.frames[data.frames.length - 1][0] + ' s';
  player.hidden = false;
})();
)";

}  // namespace taut::host
