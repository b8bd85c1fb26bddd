#include "analysis/figure/film_file.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "analysis/figure/film_canvas.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"

namespace isostat {
namespace {

namespace fs = std::filesystem;

std::string frame_name(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "frame%04zu.png", number);
  return name;
}

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

void write_frames(const PictureSeries& series, const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto canvas = make_png_canvas(series.page());
    series.draw_packing(*canvas, k);
    series.draw_legend(*canvas);
    files.emplace_back((folder / frame_name(k + 1)).string(), canvas->finish());
  }
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw InputError(folder.string(), 0, "", "", "cannot be made: " + error.message());
  write_files_atomically(files);
}

}  // namespace

bool FilmFile::names_folder(const std::string& path) { return path.ends_with('/') || fs::is_directory(path); }
bool FilmFile::names_page(const std::string& path) { return fs::path(path).extension() == ".html"; }

FilmFile::FilmFile(std::string path, double rate) : path_(std::move(path)), rate_(rate) {
  if (names_folder(path_))
    require_writable(fs::is_directory(path_) ? (fs::path(path_) / frame_name(1)).string() : without_slash(path_));
  else if (names_page(path_) || fs::path(path_).extension() == ".svg")
    require_writable(path_);
  else
    throw InputError("command line", 0, "-o", path_, "a film is .html or .svg, or a folder for its frames: DIR/");
}

void FilmFile::write(const PictureSeries& series) const {
  if (names_folder(path_)) {
    const fs::path folder = without_slash(path_);
    if (const fs::path next = folder / frame_name(series.size() + 1); fs::exists(next))
      throw InputError(next.string(), 0, "", "",
                       "is of a longer series: remove the frames of that, or name another folder");
    return write_frames(series, folder);
  }
  FilmCanvas canvas(names_page(path_) ? FilmKind::html : FilmKind::svg, series.page(), series.size(), rate_);
  series.draw_legend(canvas);
  for (std::size_t k = 0; k < series.size(); ++k) {
    canvas.begin_frame();
    series.draw_packing(canvas, k);
    canvas.end_frame();
  }
  write_file_atomically(path_, canvas.finish());
}

}  // namespace isostat
