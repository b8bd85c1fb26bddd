// A figure's file: format by extension, checked before anything is read or drawn, and never half-written.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "analysis/figure/canvas.hpp"

namespace isostat {

class FigureFile {
 public:
  // Throws InputError for an extension other than .svg, .pdf, .png, or a place where no file can be made.
  explicit FigureFile(std::string path);
  std::unique_ptr<Canvas> canvas(const Vec2& size) const;  // [pt]
  // Writes the finished canvas under a temporary name and renames it. Throws InputError if that fails.
  void write(Canvas& canvas) const;

 private:
  std::string path_;
  std::unique_ptr<Canvas> (*make_)(const Vec2&);
};

}  // namespace isostat
