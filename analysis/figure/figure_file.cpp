#include "analysis/figure/figure_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "dem/input_error.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;

std::string temporary_name(const std::string& path) { return path + ".part" + std::to_string(::getpid()); }

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError("command line", 0, "-o", path, why);
}

}  // namespace

FigureFile::FigureFile(std::string path) : path_(std::move(path)) {
  const std::string extension = fs::path(path_).extension().string();
  if (extension == ".svg")
    make_ = make_svg_canvas;
  else if (extension == ".pdf")
    make_ = make_pdf_canvas;
  else if (extension == ".png")
    make_ = make_png_canvas;
  else
    refuse(path_, "the extension must be .svg, .pdf or .png");
  std::error_code error;
  if (fs::is_directory(path_, error)) refuse(path_, "is a directory; name a file");
  const std::string trial = temporary_name(path_);
  if (!std::ofstream(trial)) refuse(path_, std::string("cannot write there: ") + std::strerror(errno));
  fs::remove(trial, error);
}

std::unique_ptr<Canvas> FigureFile::canvas(const Vec2& size) const { return make_(size); }

void FigureFile::write(Canvas& canvas) const {
  const std::string bytes = canvas.finish(), temporary = temporary_name(path_);
  std::ofstream file(temporary, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code error;
  if (!file) {
    fs::remove(temporary, error);
    refuse(path_, "cannot write the file: is the disk full?");
  }
  fs::rename(temporary, path_, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(temporary, error);
    refuse(path_, "cannot write the file: " + why);
  }
}

}  // namespace isostat
