// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace disflow::apps {

/// More is refused before it is read: a damaged or hostile file must not take all memory.
inline constexpr std::size_t kMaxFile_bytes = std::size_t{1} << 27U;

/// The whole of a file. @throws InputError if it cannot be read or is longer than `max_bytes`.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& file,
                                   std::size_t max_bytes = kMaxFile_bytes);

/// The same of a file of a sequence. @throws InputError also if it is no regular file: nobody may
/// be at the other end of a pipe.
[[nodiscard]] std::string ReadRecordedFile(const std::filesystem::path& file,
                                           std::size_t max_bytes = kMaxFile_bytes);

/// @throws InputError if the file is there and is no regular one.
void RequireRegularFile(const std::filesystem::path& file);

/// Writes through a temporary file beside the target and renames it, so that an earlier result
/// survives a full disk; of a link, the file that it leads to. Targets that are not regular files
/// (/dev/null, pipes) are written directly, and what the program was started with (/dev/stdout)
/// goes on.
/// @throws OutputError
void WriteFile(const std::filesystem::path& file, std::string_view text);

/// A line of text and its number, counted from 1.
struct Line {
  std::size_t number = 0;
  std::string_view text;  ///< Without line end (LF or CRLF).
};

/// Reads the lines of a text that hold more than white space, one after the other.
class LineReader {
 public:
  /// @param text Must outlive the lines.
  explicit LineReader(std::string_view text) : rest_(text) {}
  /// @return false if there is no other line.
  [[nodiscard]] bool Next(Line& line);
  /// Whether nothing follows the line that Next() gave last.
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Fields between separators, white space around each removed. Empty fields are kept.
[[nodiscard]] std::vector<std::string_view> SplitAt(std::string_view line, char separator);

/// Fields between runs of spaces and tabs.
[[nodiscard]] std::vector<std::string_view> SplitAtSpaces(std::string_view line);

/// The number that makes up the whole field ("nan" and "inf" included), independent of the locale.
[[nodiscard]] std::optional<double> ParseNumber(std::string_view field);

/// Reads a line of exactly `count` finite numbers separated by spaces.
/// @throws InputError naming file, line and field.
[[nodiscard]] std::vector<double> ParseNumbers(const std::filesystem::path& file, const Line& line,
                                               std::size_t count);

/// A finite number in a field. @throws InputError naming file, line and the field's `name`.
[[nodiscard]] double ParseFinite(const std::filesystem::path& file, const Line& line,
                                 std::string_view name, std::string_view field);

/// A whole number, not negative. @throws InputError naming file, line and the field's `name`.
[[nodiscard]] int ParseIndex(const std::filesystem::path& file, const Line& line,
                             std::string_view name, std::string_view field);

}  // namespace disflow::apps
