#include "workbench/report/page_style.hpp"

namespace beadwork::report {

const std::string_view page_template = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="Beadwork">
<meta name="color-scheme" content="light dark">
<title>@title@</title>
<style>@style@</style>
</head>
<body>
<main>
<header>@header@</header>
@body@
</main>
</body>
</html>
)html";

const std::string_view page_style = R"css(
:root {
  --page: #f6f7f9; --card: #ffffff; --ink: #1c2430; --soft: #5c6878; --rule: #e2e6ec; --zero: #aab3bf;
  --good: #11785a; --bad: #a4123a; --warn: #8f5a00; --idle: #56616f;
  --c0: #0072b2; --c1: #d98200; --c2: #00916a; --c3: #a8518f; --c4: #4fa3d8; --c5: #c0501a; --c6: #77808c; --c7: #9a8200;
  font: 15px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "DejaVu Sans", sans-serif;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12161b; --card: #1a2027; --ink: #e4e8ee; --soft: #9aa5b3; --rule: #2c343e; --zero: #55606d;
    --good: #4cc79f; --bad: #ff7d98; --warn: #f0b454; --idle: #a3adb9;
    --c0: #56aee6; --c1: #f2a83c; --c2: #3cc79c; --c3: #d68cc3; --c4: #93cdf3; --c5: #f28a55; --c6: #a5aeb9; --c7: #d2bb48;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); }
main { max-width: 1240px; margin: 0 auto; padding: 34px 24px 60px; }
header { margin: 0 0 22px; }
h1 { display: inline-block; font-size: 30px; font-weight: 650; letter-spacing: -.015em; line-height: 1.2; margin: 0 12px 0 0; }
header p { color: var(--soft); margin: 4px 0 0; overflow-wrap: anywhere; }
.badge { display: inline-block; vertical-align: 6px; padding: 1px 11px 2px; border-radius: 99px; font-size: 13px; font-weight: 600;
  color: var(--kind); border: 1.5px solid var(--kind); }
.badge.done { --kind: var(--good); } .badge.failed { --kind: var(--bad); }
.badge.interrupted { --kind: var(--warn); } .badge { --kind: var(--idle); }
section { background: var(--card); border: 1px solid var(--rule); border-radius: 12px; padding: 20px 24px 18px; margin: 0 0 18px; }
h2 { font-size: 18px; font-weight: 640; margin: 0 0 10px; }
p { margin: 6px 0 10px; }
.notes { border-left: 4px solid var(--warn); }
.notes ul { margin: 0; padding-left: 18px; } .notes li { margin: 2px 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(124px, 1fr)); gap: 14px 18px; margin: 0; }
.tiles dt { color: var(--soft); font-size: 13px; } .tiles dt::first-letter { text-transform: uppercase; }
.tiles dd { margin: 1px 0 0; font-size: 17.5px; font-weight: 620; line-height: 1.4; white-space: nowrap; font-variant-numeric: tabular-nums; }
.tiles small { font-size: 13px; font-weight: 400; color: var(--soft); }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }
th { text-align: left; font-weight: 450; color: var(--soft); padding: 5px 18px 5px 0; vertical-align: top; }
td { padding: 5px 0 5px 14px; text-align: right; overflow-wrap: anywhere; }
tr + tr > * , tbody tr > * { border-top: 1px solid var(--rule); }
tbody tr:first-child > * { border-top: 0; } thead + tbody tr:first-child > * { border-top: 1px solid var(--rule); }
th::first-letter { text-transform: uppercase; }
thead th { font-size: 13px; } thead th:not(:first-child) { text-align: right; padding-right: 0; }
tr.input > *, tr.residual > * { color: var(--ink); font-weight: 600; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(500px, 100%), 1fr)); gap: 20px 34px; }
.beside { display: grid; grid-template-columns: minmax(0, 1.55fr) minmax(260px, 1fr); gap: 10px 40px; align-items: start; }
.beside > :only-child { grid-column: 1 / -1; }
@media (max-width: 820px) { .beside { grid-template-columns: 1fr; } }
figure { margin: 0; }
.chart figcaption { font-weight: 600; } .chart figcaption::first-letter { text-transform: uppercase; }
.chart > svg { display: block; width: 100%; height: auto; overflow: visible; }
.legend, .states { display: flex; flex-wrap: wrap; gap: 2px 18px; color: var(--soft); font-size: 13.5px; }
.legend { margin: 2px 0 6px; min-height: 21px; }
.legend span, .states span { white-space: nowrap; }
.key { display: inline-block; vertical-align: middle; margin: -2px 7px 0 0; }
.key.stroke, .key.dashed { width: 20px; border-top: 2.6px solid var(--s); } .key.dashed { border-top-style: dashed; }
.key.block { width: 13px; height: 13px; border-radius: 3px; background: var(--s); opacity: .8; }
.key.disc { width: 11px; height: 11px; border-radius: 50%; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.s0 { --s: var(--c0); } .s1 { --s: var(--c1); } .s2 { --s: var(--c2); } .s3 { --s: var(--c3); }
.s4 { --s: var(--c4); } .s5 { --s: var(--c5); } .s6 { --s: var(--c6); } .s7 { --s: var(--c7); }
svg text { fill: var(--soft); font-size: 13px; font-variant-numeric: tabular-nums; } svg .label { font-size: 13.5px; }
.grid { stroke: var(--rule); stroke-width: 1; } .grid.zero, .base { stroke: var(--zero); stroke-width: 1.2; }
.line { fill: none; stroke: var(--s); stroke-width: 2; stroke-linejoin: round; stroke-linecap: round; }
.line.dashed { stroke-dasharray: 7 5; stroke-linecap: butt; }
.area { fill: var(--s); fill-opacity: .68; stroke: var(--card); stroke-width: .8; }
.bar { fill: var(--c0); fill-opacity: .75; } .bar:hover { fill-opacity: 1; }
svg .leaves { fill: var(--ink); font-size: 12px; paint-order: stroke; stroke: var(--card); stroke-width: 4px; }
.marker circle { fill: var(--card); stroke: var(--ink); stroke-width: 1.3; }
svg .marker text { fill: var(--ink); font-size: 10.5px; font-weight: 650; }
.probes rect { fill: transparent; }
.probes line, .probes circle, .probes text { opacity: 0; pointer-events: none; }
.probes line { stroke: var(--zero); } .probes circle { fill: var(--s); stroke: var(--card); stroke-width: 1.4; }
svg .probes text { fill: var(--ink); paint-order: stroke; stroke: var(--card); stroke-width: 6px; }
.probes g:hover > * { opacity: 1; }
.frames { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(330px, 100%), 1fr)); gap: 22px 30px; }
.frames.wide { grid-template-columns: 1fr; gap: 8px; }
.frame { break-inside: avoid; border-top: 1px solid var(--rule); padding-top: 10px; }
.frame figcaption { display: flex; flex-wrap: wrap; align-items: baseline; gap: 2px 12px; margin-bottom: 4px; }
.no { display: inline-grid; place-items: center; width: 21px; height: 21px; border: 1.4px solid var(--ink); border-radius: 50%;
  font-size: 12px; font-weight: 650; }
.when { color: var(--soft); font-size: 13.5px; } .states { margin-left: auto; }
.view { position: relative; width: fit-content; max-width: 100%; margin: 4px auto 0; }
.view:has(.scale) { padding-bottom: 17px; }
.view img { display: block; max-width: 100%; height: auto; }
.scale { position: absolute; left: 0; bottom: 11px; height: 4px; border: solid var(--soft); border-width: 0 1.3px 1.3px; }
.scale b { position: absolute; left: calc(100% + 7px); top: -9px; font: 12px/1.4 system-ui, sans-serif; color: var(--soft); white-space: nowrap; }
.field { break-inside: avoid; border-top: 1px solid var(--rule); padding-top: 10px; margin-bottom: 14px; }
.field figcaption b { display: inline-block; }
.field figcaption b::first-letter { text-transform: uppercase; }
.colorbar { display: inline-flex; align-items: center; gap: 8px; margin-left: 18px; color: var(--soft); font-size: 13px; }
.colorbar i { width: 180px; height: 11px; border-radius: 3px; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
details { margin: 4px 0; } summary { cursor: pointer; color: var(--soft); padding: 3px 0; } summary:hover { color: var(--ink); }
details.quiet { margin-top: 12px; font-size: 14px; }
pre { font: 12.5px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; overflow: auto; max-height: 560px;
  background: var(--page); border: 1px solid var(--rule); border-radius: 8px; padding: 12px 14px; margin: 6px 0; tab-size: 2; }
@media print {
  :root { --page: #fff; --card: #fff; --ink: #111; --soft: #444; --rule: #ccc; font-size: 11px; }
  main { max-width: none; padding: 0; } section { border: 0; padding: 6px 0; } .probes { display: none; }
  .chart, .frame, tr, .beside { break-inside: avoid; } h2 { break-after: avoid; }
  .charts { grid-template-columns: 1fr 1fr; } pre { max-height: none; white-space: pre-wrap; }
}
.turnable .controls { display: flex; flex-wrap: wrap; gap: 6px 18px; align-items: center; margin-bottom: 8px; }
.turnable .stage canvas { width: 100%; height: 460px; display: block; touch-action: none; cursor: grab; }
.turnable .bar { visibility: hidden; display: flex; gap: 8px; align-items: center; }
.turnable .bar i { width: 220px; height: 10px; background: linear-gradient(90deg, #440054, #3b528c, #21918c, #5ec962, #fde725); }
.turnable .info { min-height: 3em; color: var(--soft); }
.turnable.none .controls, .turnable.none .bar { display: none; }
)css";

}  // namespace beadwork::report
