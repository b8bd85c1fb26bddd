#include "analysis/figure/packing_picture.hpp"

namespace isostat {

PackingPicture::PackingPicture(const Packing<2>& packing, std::unique_ptr<PictureContent> content,
                               const RichText& length_unit) {
  std::vector<std::unique_ptr<PictureSubject>> subjects;
  subjects.push_back(std::make_unique<DiskSubject>(packing, std::move(content)));
  series_ = std::make_unique<PictureSeries>(std::move(subjects), length_unit);
}

}  // namespace isostat
