// Columns against each other as an HTML page: the SVG picture with a script.
#include "compiler/plot/json.hpp"
#include "compiler/plot/xy_plot.hpp"
#include "runtime/common/text.hpp"

#include <fmt/format.h>

namespace stc::plot {

namespace {

constexpr std::string_view kStyle =
    "body { margin: 12px; font: 13px Helvetica, Arial, sans-serif; color: #374151; }\n"
    "p { margin: 0 0 8px; color: #6b7280; }\n"
    "svg { display: block; max-width: 100%; height: auto; cursor: crosshair; }\n";

/// The nearest row at the cursor; the wheel zooms, a drag moves, a double click shows all.
constexpr std::string_view kScript = R"script(
'use strict';
const data = JSON.parse(document.getElementById('trace').textContent);
const svg = document.querySelector('svg');
const says = document.getElementById('says');
const all = svg.getAttribute('viewBox').split(' ').map(Number);
let view = [...all], drag = null;
const ring = document.createElementNS(svg.namespaceURI, 'circle');
for (const [name, value] of [['r', 4], ['fill', 'none'], ['stroke', '#d55e00'], ['visibility', 'hidden']])
  ring.setAttribute(name, value);
svg.append(ring);
function show() {
  svg.setAttribute('viewBox', view.join(' '));
  ring.setAttribute('r', 4 * view[2] / all[2]);
}
function placeOf(event) {
  return new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
}
function number(value) { return value === null ? '' : String(+value.toPrecision(7)); }
svg.addEventListener('mousemove', event => {
  const at = placeOf(event);
  if (drag) {
    view[0] += drag.x - at.x;
    view[1] += drag.y - at.y;
    show();
    return;
  }
  let best = null;
  for (const curve of data.curves)
    for (let i = 0; i < data.time.length; ++i) {
      if (curve.across[i] === null || curve.upwards[i] === null) continue;
      const x = data.x[0] + data.x[1] * curve.across[i], y = data.y[0] + data.y[1] * curve.upwards[i];
      const far = Math.hypot(x - at.x, y - at.y);
      if (!best || far < best.far) best = {far, x, y, i, curve};
    }
  if (!best) return;
  ring.setAttribute('cx', best.x);
  ring.setAttribute('cy', best.y);
  ring.setAttribute('visibility', 'visible');
  const parts = [`t = ${number(data.time[best.i])} s`, `${best.curve.names[0]} = ${number(best.curve.across[best.i])}`,
    `${best.curve.names[1]} = ${number(best.curve.upwards[best.i])}`];
  if (data.color) parts.push(`${data.color.name} = ${number(data.color.values[best.i])}`);
  says.textContent = parts.join(', ');
});
svg.addEventListener('mousedown', event => { drag = placeOf(event); event.preventDefault(); });
addEventListener('mouseup', () => { drag = null; });
svg.addEventListener('dblclick', () => { view = [...all]; show(); });
svg.addEventListener('wheel', event => {
  const at = placeOf(event), factor = event.deltaY < 0 ? 0.8 : 1.25;
  view = [at.x + (view[0] - at.x) * factor, at.y + (view[1] - at.y) * factor, view[2] * factor, view[3] * factor];
  show();
  event.preventDefault();
}, {passive: false});
)script";

std::string dataOf(const Trace &trace, const XyPicture &picture) {
  const XyFrame frame = frameOf(trace, picture);
  std::string out = fmt::format("{{\"x\":[{},{}],\"y\":[{},{}],\"time\":", frame.x(0), frame.scaleX,
                                frame.y(0), -frame.scaleY);
  appendJson(out, trace.time);
  out += ",\"curves\":[";
  for (const XyCurve &curve : picture.curves) {
    if (out.back() == '}')
      out += ',';
    out += fmt::format("{{\"names\":[{},{}],\"across\":", jsonText(curve.across->name),
                       jsonText(curve.upwards->name));
    appendJson(out, curve.across->values);
    out += ",\"upwards\":";
    appendJson(out, curve.upwards->values);
    out += '}';
  }
  out += ']';
  if (picture.color != nullptr) {
    out += fmt::format(",\"color\":{{\"name\":{},\"values\":", jsonText(picture.color->name));
    appendJson(out, picture.color->values);
    out += '}';
  }
  return out + '}';
}

} // namespace

std::string drawXyPage(const Trace &trace, const XyPicture &picture) {
  const std::string title =
      stride::common::escapedMarkup(trace.title.empty() ? std::string("Trace") : trace.title);
  std::string page = fmt::format("<!doctype html>\n<html lang=\"en\"><head><meta "
                                 "charset=\"utf-8\"><title>{}</title>\n<style>\n{}</style></head>"
                                 "<body>\n",
                                 title, kStyle);
  page += "<p>The cursor shows the nearest row. Turn the wheel to zoom, drag to move, double-click "
          "to see all.</p>\n<p id=\"says\">&nbsp;</p>\n";
  page += drawXySvg(trace, picture);
  page += "<script id=\"trace\" type=\"application/json\">" + dataOf(trace, picture) +
          "</script>\n<script>" + std::string(kScript) + "</script></body></html>\n";
  return page;
}

} // namespace stc::plot
