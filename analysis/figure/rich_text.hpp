// Text with italics, subscripts and superscripts, as axis labels need it.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

struct TextRun {
  std::string text;  // UTF-8
  bool italic = false;
  int script = 0;  // -1 subscript, 0 baseline, +1 superscript
  friend bool operator==(const TextRun&, const TextRun&) = default;
};
using RichText = std::vector<TextRun>;

inline constexpr double kScriptSize = 0.72;   // size of a script relative to its base
inline constexpr double kScriptRaise = 0.36;  // [em of the base] shift of a superscript's baseline
inline constexpr double kScriptDrop = 0.18;   // [em of the base] shift of a subscript's

// Markup for our own labels: `k` italic, _{0} subscript, ^{2} superscript (they may hold italics, and do not nest).
RichText rich(std::string_view markup);

// Text of others (column names, file names): taken as it stands.
RichText plain(std::string_view text);

RichText operator+(RichText a, const RichText& b);

// Width in points at a size in points, by the font that the figures use.
double text_width(const RichText& text, double size);

}  // namespace isostat
