#include "analysis/figure/rich_text.hpp"

namespace isostat {
namespace {

void append(RichText& text, char c, bool italic, int script) {
  if (text.empty() || text.back().italic != italic || text.back().script != script)
    text.push_back({std::string(), italic, script});
  text.back().text += c;
}

}  // namespace

RichText rich(std::string_view markup) {
  RichText text;
  bool italic = false;
  int script = 0;
  for (std::size_t i = 0; i < markup.size(); ++i) {
    const char c = markup[i];
    const bool opens = i + 1 < markup.size() && markup[i + 1] == '{';
    if (c == '`') {
      italic = !italic;
    } else if ((c == '_' || c == '^') && opens && script == 0) {
      script = c == '_' ? -1 : 1;
      ++i;
    } else if (c == '}' && script != 0) {
      script = 0;
    } else {
      append(text, c, italic, script);
    }
  }
  return text;
}

RichText plain(std::string_view text) { return text.empty() ? RichText{} : RichText{{std::string(text), false, 0}}; }

RichText operator+(RichText a, const RichText& b) {
  for (const TextRun& run : b) {
    if (!a.empty() && a.back().italic == run.italic && a.back().script == run.script)
      a.back().text += run.text;
    else
      a.push_back(run);
  }
  return a;
}

}  // namespace isostat
