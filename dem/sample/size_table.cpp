#include "dem/sample/size_table.hpp"

#include <algorithm>
#include <cmath>

#include "dem/files/atomic_file.hpp"
#include "dem/files/formats/table_packing.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

constexpr double kRounding = 1e-3;  // of printed shares, by which their sum may miss 1

class SizeTable {
 public:
  SizeTable(const TextTable& table) : table_(table) {
    diameter_ = column("diameter"), share_ = column("share"), passing_ = column("passing");
    density_ = column("density");
  }

  void check() {
    if (faults_.empty()) check_columns();
    if (faults_.empty()) check_values();
    if (faults_.empty()) check_sum();
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }

  std::vector<SizeClass> classes(ShareOf share_of, int dimension, double largest) const {
    const double scale = largest / this->largest();
    const double exponent = share_of == ShareOf::volume ? dimension : 0;
    std::vector<SizeClass> classes;
    double sum = 0;
    const auto add = [&](double share, double low, double high, std::size_t row) {
      if (!(share > 0)) return;
      classes.push_back({share, {scale * low, scale * high, exponent}, density_.empty() ? 1 : density_[row]});
      if (share_of == ShareOf::volume) classes.back().share /= classes.back().range.moment(dimension);
      sum += classes.back().share;
    };
    for (std::size_t k = 0; k < share_.size(); ++k) add(share_[k], diameter_[k], diameter_[k], k);
    for (std::size_t k = 1; k < passing_.size(); ++k)
      add(passing_[k] - passing_[k - 1], diameter_[k - 1], diameter_[k], k);
    for (SizeClass& c : classes) c.share /= sum;
    return classes;
  }

 private:
  std::vector<double> column(const char* name) { return real_column(table_, name, faults_); }
  void fault(std::size_t row, const char* name, double value, std::string rule) {
    faults_.push_back({table_.path, table_.lines[row], name, real_text(value), std::move(rule)});
  }

  void check_columns() {
    const auto has = [&](const char* name) { return table_.column(name).has_value(); };
    const auto header_fault = [&](const char* name, const char* rule) {
      faults_.push_back({table_.path, table_.header_line, name, "", rule});
    };
    if (!has("diameter")) header_fault("diameter", "column is missing; a table of sizes is diameter,share");
    if (!has("share") && !has("passing"))
      header_fault("share", "column is missing; or passing, the share that is smaller");
    if (has("share") && has("passing")) header_fault("passing", "a table has shares or what passes, not both");
    if (table_.rows() < (has("passing") ? 2u : 1u)) header_fault("diameter", "the table has too few rows");
  }

  void check_values() {
    for (std::size_t k = 0; k < diameter_.size(); ++k) {
      if (!(diameter_[k] > 0)) fault(k, "diameter", diameter_[k], "must be positive");
      if (k > 0 && !(diameter_[k] > diameter_[k - 1]))
        fault(k, "diameter", diameter_[k], "diameters ascend: the row before has " + real_text(diameter_[k - 1]));
    }
    for (std::size_t k = 0; k < share_.size(); ++k)
      if (!(share_[k] >= 0)) fault(k, "share", share_[k], "must not be negative");
    for (std::size_t k = 0; k < passing_.size(); ++k)
      if (!(passing_[k] >= 0) || (k > 0 && !(passing_[k] >= passing_[k - 1])))
        fault(k, "passing", passing_[k], "starts at 0 and never falls: it is the share of all smaller grains");
    for (std::size_t k = 0; k < density_.size(); ++k)
      if (!(density_[k] > 0)) fault(k, "density", density_[k], "must be positive");
  }

  void check_sum() {
    double sum = 0;
    for (const double share : share_) sum += share;
    const std::size_t last = diameter_.size() - 1;
    if (!share_.empty() && !(std::abs(sum - 1) <= kRounding))
      fault(last, "share", sum, "is what the shares add up to, in place of 1: write 0.25 for 25 %");
    if (passing_.empty()) return;
    if (passing_.front() != 0) fault(0, "passing", passing_.front(), "starts at 0, at the smallest diameter of all");
    if (!(std::abs(passing_.back() - 1) <= kRounding))
      fault(last, "passing", passing_.back(), "ends at 1, at the largest diameter of all: write 0.25 for 25 %");
  }

  // Of a grain that there is.
  double largest() const {
    for (std::size_t k = diameter_.size(); k-- > 0;)
      if (passing_.empty() ? share_[k] > 0 : k > 0 && passing_[k] > passing_[k - 1]) return diameter_[k];
    return diameter_.back();
  }

  const TextTable& table_;
  std::vector<double> diameter_, share_, passing_, density_;
  std::vector<Fault> faults_;
};

}  // namespace

std::vector<SizeClass> read_size_table(const std::string& path, ShareOf share_of, int dimension, double largest) {
  const TextTable columns = parse_table(read_whole_file(path), path);
  SizeTable table(columns);
  table.check();
  return table.classes(share_of, dimension, largest);
}

}  // namespace isostat
