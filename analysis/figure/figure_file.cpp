#include "analysis/figure/figure_file.hpp"

#include <filesystem>

#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {

FigureFile::FigureFile(std::string path) : path_(std::move(path)) {
  const std::string extension = std::filesystem::path(path_).extension().string();
  if (extension == ".svg")
    make_ = make_svg_canvas;
  else if (extension == ".pdf")
    make_ = make_pdf_canvas;
  else if (extension == ".png")
    make_ = make_png_canvas;
  else
    throw InputError("command line", 0, "-o", path_, "the extension must be .svg, .pdf or .png");
  require_writable(path_);
}

std::unique_ptr<Canvas> FigureFile::canvas(const Vec2& size) const { return make_(size); }

void FigureFile::write(Canvas& canvas) const { write_file_atomically(path_, canvas.finish()); }

}  // namespace isostat
