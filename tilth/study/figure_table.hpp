// A table of figures, shown as text, Markdown, CSV and JSON: the same cells everywhere, rounded only for people.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tilth {

struct FigureColumn {
  std::string key;    ///< in CSV and JSON: names its unit
  std::string title;  ///< for people
  int decimals = 0;   ///< for people
};

/// A number, a word, or nothing.
struct Figure {
  Figure() = default;
  Figure(double value) : number(value) {}
  Figure(std::string text) : word(std::move(text)), is_word(true) {}

  std::optional<double> number;
  std::string word;
  bool is_word = false;
};

struct FigureTable {
  std::string title;
  std::vector<FigureColumn> columns;
  std::vector<std::vector<Figure>> rows;  ///< one figure a column
  std::vector<std::string> notes;         ///< sentences below the table
};

/// The titles, then every row, as people read them.
std::vector<std::vector<std::string>> table_words(const FigureTable& table);

/// Numbers to the right, words to the left; a figure that is missing is "-".
std::string table_text(const FigureTable& table);

/// The same for GitHub; what the words hold of Markdown or HTML is shown as it is.
std::string table_markdown(const FigureTable& table);

/// The keys, then one line a row with all digits (RFC 4180); a figure that is missing is empty.
std::string table_csv(const FigureTable& table);

/// An object of one entry a table, by `names`: "title", "notes" and "rows", an array of objects by the columns' keys. A
/// figure that is missing or not finite is null.
std::string tables_json(std::span<const std::string> names, std::span<const FigureTable> tables);

}  // namespace tilth
