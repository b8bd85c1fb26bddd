#include "analysis/figure/film_canvas.hpp"

#include <algorithm>
#include <charconv>
#include <string>

namespace isostat {
namespace {

constexpr std::size_t kWorthUsing = 100;  // [bytes] of a group that is not written again
constexpr int kDecimals = 1;              // [pt] of a film: a tenth of a point is finer than a pixel of most screens

std::string text_of(double x) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 6).ptr};
}

constexpr std::string_view kPageHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Isostat film</title>
<style>
body { margin: 1em; font-family: DejaVu Sans, Verdana, Arial, sans-serif; }
svg { display: block; max-width: 100%; max-height: 88vh; }
form { display: flex; gap: 0.6em; align-items: center; margin-top: 0.5em; max-width: 60em; }
input[type=range] { flex: 1; }
</style>
</head>
<body>
)";

// Space plays and stops, arrow keys go on by one frame.
constexpr std::string_view kPageFoot = R"(<form onsubmit="return false">
<button id="play" type="button">Play</button>
<input id="at" type="range" min="1" value="1" aria-label="frame">
<output id="count"></output>
<label>fps <input id="rate" type="number" min="0.1" max="100" step="any"></label>
</form>
<script>
"use strict";
const frames = document.querySelectorAll("g.frame"), at = document.getElementById("at");
const play = document.getElementById("play"), rate = document.getElementById("rate");
let shown = 0, timer = 0;
function show(k) {
  frames[shown].setAttribute("display", "none");
  shown = (k + frames.length) % frames.length;
  frames[shown].removeAttribute("display");
  at.value = shown + 1;
  document.getElementById("count").textContent = (shown + 1) + " / " + frames.length;
}
function stop() { clearInterval(timer); timer = 0; play.textContent = "Play"; }
function start() {
  clearInterval(timer);
  timer = setInterval(() => show(shown + 1), 1000 / (Number(rate.value) || 1));
  play.textContent = "Pause";
}
at.max = frames.length;
rate.value = framesPerSecond;
at.addEventListener("input", () => { stop(); show(Number(at.value) - 1); });
rate.addEventListener("change", () => { if (timer) start(); });
play.addEventListener("click", () => timer ? stop() : start());
document.addEventListener("keydown", e => {
  if (e.target.tagName === "INPUT" || (e.target === play && e.key === " ")) return;
  if (e.key === " ") { e.preventDefault(); timer ? stop() : start(); }
  else if (e.key === "ArrowRight") { stop(); show(shown + 1); }
  else if (e.key === "ArrowLeft") { stop(); show(shown - 1); }
});
show(0);
start();
</script>
</body>
</html>
)";

}  // namespace

FilmCanvas::FilmCanvas(FilmKind kind, const Vec2& size, std::size_t frames, double rate)
    : SvgCanvas(size, kDecimals), kind_(kind), frames_(frames), rate_(rate) {}

// Where nothing moves, as on paper, the first frame shows.
void FilmCanvas::begin_frame() {
  const std::size_t k = begun_++;
  raw(k == 0 ? "<g class=\"frame\">\n" : "<g class=\"frame\" display=\"none\">\n");
  if (kind_ == FilmKind::html || frames_ == 1) return;
  const double n = static_cast<double>(frames_), from = static_cast<double>(k) / n, to = static_cast<double>(k + 1) / n;
  std::string values = k == 0 ? "inline" : "none;inline", times = k == 0 ? "0" : "0;" + text_of(from);
  if (k + 1 < frames_) values += ";none", times += ';' + text_of(to);
  raw("<animate attributeName=\"display\" calcMode=\"discrete\" repeatCount=\"indefinite\" dur=\"" +
      text_of(n / rate_) + "s\" values=\"" + values + "\" keyTimes=\"" + times + "\"/>\n");
}

void FilmCanvas::begin_group(std::string_view name) {
  const std::size_t begin = written().size();
  SvgCanvas::begin_group(name);
  open_.push_back({begin, written().size(), 0, last_id()});
}

void FilmCanvas::end_group() {
  Group group = std::move(open_.back());
  open_.pop_back();
  const std::string_view all = written(), body = all.substr(group.body);
  group.size = body.size();
  const std::size_t hash = std::hash<std::string_view>()(body);
  const auto [first, last] = seen_.equal_range(hash);
  const auto same =
      std::find_if(first, last, [&](const auto& s) { return body == all.substr(s.second.body, s.second.size); });
  if (body.size() < kWorthUsing || same == last) {
    SvgCanvas::end_group();
    seen_.emplace(hash, std::move(group));
    return;
  }
  forget_from(group.begin);
  raw("<use href=\"#" + same->second.id + "\"/>\n");
}

std::string FilmCanvas::finish() {
  if (kind_ == FilmKind::svg) return SvgCanvas::finish();
  std::string page(kPageHead);
  page += element();
  page += "<script>const framesPerSecond = " + text_of(rate_) + ";</script>\n";
  page += kPageFoot;
  return page;
}

}  // namespace isostat
