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
svg text.lean{font-size:10px}
svg text{font-size:12px;fill:var(--soft);stroke:none;font-variant-numeric:tabular-nums}
.x-title{text-align:right;padding-right:10px;margin-top:-2px}
.grid line{stroke:var(--rule);stroke-width:1}
polyline,.sample line{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round;vector-effect:non-scaling-stroke}
.estimate,.line-1{stroke:var(--one)}
.line-2{stroke:var(--two);stroke-dasharray:9 4}
.line-3{stroke:var(--three);stroke-dasharray:2 4}
.nominal{stroke:var(--two);stroke-dasharray:7 4}
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
@media (max-width:40rem){th,td{padding:.3rem .4rem}
.alarms thead{display:none}.alarms tr{display:block;padding:.4rem 0;border-bottom:1px solid var(--rule)}
.alarms td{display:inline-block;border:0;padding:.1rem .8rem .1rem 0;white-space:normal;text-align:left}
.alarms td.text{display:block}.alarms td:first-child::before{content:"row "}.alarms td:nth-child(2)::after{content:" s"}}
@media print{body{max-width:none;padding:0;font-size:11pt}.player{display:none}h2,h3{break-after:avoid}tr{break-inside:avoid}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}.wide{overflow:visible}
table{font-size:8.5pt}th,td{padding:.15rem .3rem}td.text{min-width:0}.number,.short{white-space:normal}}
)";

/// Moves the drawing of the structure through time. Without `<` and `&`, so that the page is XML as well.
inline constexpr const char* page_script = R"(
(function () {
  var data = JSON.parse(document.getElementById('frames').textContent);
  var player = document.getElementById('player');
  var slider = player.querySelector('input'), shown = player.querySelector('output');
  var structure = document.querySelector('.structure');
  var segments = structure.querySelectorAll('.segment'), joints = structure.querySelectorAll('.joint');
  var numbers = document.querySelectorAll('.scale text');
  function show(frame) {
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
    });
    joints.forEach(function (joint, j) {
      var state = data.states[frame[2].charAt(j)];
      joint.querySelector('path').setAttribute('class', state[0]);
      joint.querySelector('path').setAttribute('d', state[1]);
      joint.querySelector('title').textContent = joint.dataset.name + ': ' + state[0];
    });
  }
  slider.max = slider.value = data.frames.length - 1;
  slider.addEventListener('input', function () { show(data.frames[slider.value]); });
  shown.textContent = data.frames[data.frames.length - 1][0] + ' s';
  player.hidden = false;
})();
)";

}  // namespace taut::host
