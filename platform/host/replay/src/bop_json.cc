// SPDX-License-Identifier: BSD-3-Clause
#include "bop_json.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "text_table.h"

namespace disflow::host {
namespace {

using Json = nlohmann::json;

/// Takes the file apart while it is parsed; its tree would take twenty times the memory.
class EntryReader final : public nlohmann::json_sax<Json> {
 public:
  EntryReader(const std::filesystem::path& file,
              const std::function<hal::Fault(const BopEntry&)>& take)
      : file_(file), take_(take) {}

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t value) override { return Add(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return Add(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return Add(value); }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*elements*/) override {
    ++depth_;
    // Of an image itself, or in its list.
    if (entry_depth_ == 0 && (depth_ == 2 || (depth_ == 3 && in_list_))) {
      entry_depth_ = depth_;
      entry_.fields.clear();
    }
    return true;
  }
  bool key(string_t& text) override {
    if (depth_ == 1) return TakeImage(text);
    if (depth_ != entry_depth_) return true;
    if (entry_.fields.size() == kMostFields) return Fail("has too many fields");
    field_ = &entry_.fields[text.substr(0, kLongestName)];
    field_->clear();
    return true;
  }
  bool end_object() override {
    const bool is_entry = depth_ == entry_depth_;
    --depth_;
    if (!is_entry) return true;
    entry_depth_ = 0;
    field_ = nullptr;
    fault_ = take_(entry_);
    return fault_.ok();
  }
  bool start_array(std::size_t /*elements*/) override {
    in_list_ = in_list_ || depth_ == 1;
    ++depth_;
    return true;
  }
  bool end_array() override {
    --depth_;
    in_list_ = in_list_ && depth_ > 1;
    return true;
  }
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const Json::exception& /*error*/) override {
    fault_ =
        hal::MakeFault(Status::kCorrupt, "%s: is no JSON at its byte %zu", file_.c_str(), position);
    return false;
  }

  [[nodiscard]] const hal::Fault& fault() const { return fault_; }

 private:
  static constexpr std::size_t kMostFields = 64;
  static constexpr std::size_t kMostNumbers = 64;
  static constexpr std::size_t kLongestName = 64;

  bool TakeImage(const std::string& text) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, entry_.image);
    constexpr std::uint64_t kHighest = 1'000'000'000;
    if (error == std::errc{} && stop == end && entry_.image <= kHighest) return true;
    fault_ = hal::MakeFault(Status::kCorrupt, "%s: '%.40s' is no number of an image", file_.c_str(),
                            text.c_str());
    return false;
  }

  /// Numbers of the field itself and of its list.
  bool Add(double value) {
    if (field_ == nullptr || depth_ > entry_depth_ + 1) return true;
    if (field_->size() == kMostNumbers) return Fail("a field has too many numbers");
    if (!std::isfinite(value)) return Fail("a number is not finite");
    field_->push_back(value);
    return true;
  }

  bool Fail(const char* problem) {
    fault_ = hal::MakeFault(Status::kCorrupt, "%s: image %ju: %s", file_.c_str(),
                            std::uintmax_t{entry_.image}, problem);
    return false;
  }

  const std::filesystem::path& file_;
  const std::function<hal::Fault(const BopEntry&)>& take_;
  hal::Fault fault_;
  int depth_ = 0;        ///< Objects and lists that are open.
  int entry_depth_ = 0;  ///< Of the entry that is being read; 0: none.
  bool in_list_ = false;
  BopEntry entry_;
  std::vector<double>* field_ = nullptr;
};

}  // namespace

std::span<const double> BopEntry::Numbers(const char* field, std::size_t count) const {
  const auto found = fields.find(field);
  if (found == fields.end() || found->second.size() != count) return {};
  return found->second;
}

hal::Fault ReadBopJson(const std::filesystem::path& file,
                       const std::function<hal::Fault(const BopEntry&)>& take) {
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 26U;
  std::string text;
  const hal::Fault fault = ReadTextFile(file, kMaxBytes, text);
  if (!fault.ok()) return fault;
  EntryReader reader(file, take);
  (void)Json::sax_parse(text, &reader);  // the reader knows better what went wrong
  return reader.fault();
}

}  // namespace disflow::host
