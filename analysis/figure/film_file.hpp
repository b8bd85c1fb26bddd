// Where a series of pictures goes: a folder of PNG frames, or one file that plays. Checked before anything is read or
// drawn, and never half-written.
#pragma once
#include <string>

#include "analysis/figure/picture_series.hpp"

namespace isostat {

class FilmFile {
 public:
  // A folder (it exists, or the path ends with '/'), an .html or an .svg.
  static bool names_folder(const std::string& path);
  static bool names_page(const std::string& path);  // .html

  // rate [1/s]: of what plays. Throws InputError for a path of another kind, or a place where no file can be made.
  FilmFile(std::string path, double rate);
  // Frames are frame0001.png, ... Throws InputError where the files cannot be written, or the folder holds more frames
  // than these: of another series, and a film made of the folder would run on into it.
  void write(const PictureSeries& series) const;

 private:
  std::string path_;
  double rate_;
};

}  // namespace isostat
