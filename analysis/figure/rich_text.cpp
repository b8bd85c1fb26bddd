#include "analysis/figure/rich_text.hpp"

#include <algorithm>

namespace isostat {
namespace {

void append(RichText& text, char c, bool italic, int script) {
  if (text.empty() || text.back().italic != italic || text.back().script != script)
    text.push_back({std::string(), italic, script});
  text.back().text += c;
}

// Length of the UTF-8 character that begins here (RFC 3629); 0: none does.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0) != 0x80) return 0;
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool surrogate = first == 0xed && byte(1) >= 0xa0, beyond = first == 0xf4 && byte(1) >= 0x90;
  return overlong || surrogate || beyond ? 0 : length;
}

// Names in files are bytes; what is no character that an SVG may hold is drawn as U+FFFD.
std::string valid_utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = character(text);
    const bool control = length == 1 && static_cast<unsigned char>(text[0]) < 0x20 && text[0] != '\t';
    if (length == 0 || control)
      valid += "\xef\xbf\xbd";
    else
      valid += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return valid;
}

}  // namespace

RichText rich(std::string_view given) {
  const std::string markup = valid_utf8(given);
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

RichText plain(std::string_view text) { return text.empty() ? RichText{} : RichText{{valid_utf8(text), false, 0}}; }

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
