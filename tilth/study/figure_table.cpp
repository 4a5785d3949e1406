#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <tilth/study/figure_table.hpp>

namespace tilth {
namespace {

using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

constexpr double kLargestCount = 1e15;  // whole numbers below are written without a point

std::string rounded(const Figure& figure, int decimals) {
  if (figure.is_word) return figure.word;
  if (!figure.number || !std::isfinite(*figure.number)) return "-";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, *figure.number);
  return text.data();
}

Json exact(const Figure& figure) {
  if (figure.is_word) return figure.word;
  if (!figure.number || !std::isfinite(*figure.number)) return nullptr;
  const bool whole = *figure.number == std::floor(*figure.number) && std::abs(*figure.number) < kLargestCount;
  return whole ? Json(std::int64_t(*figure.number)) : Json(*figure.number);
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Whether a column holds words: then it is set to the left.
bool has_words(const FigureTable& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [column](const auto& row) { return row[column].is_word; });
}

std::string padded(std::string word, std::size_t width, bool left) {
  word.insert(left ? word.size() : 0, width - std::min(width, word.size()), ' ');
  return word;
}

std::string markdown_word(const std::string& word) {
  std::string text;
  for (const char c : word) {
    if (std::string("|<>*_`[]\\").find(c) != std::string::npos) text += '\\';
    text += c == '\n' || c == '\r' ? ' ' : c;
  }
  return text;
}

std::string csv_word(const std::string& word) {
  if (word.find_first_of(",\"\n\r") == std::string::npos) return word;
  std::string text = "\"";
  for (const char c : word) text.append(c == '"' ? 2 : 1, c);
  return text + "\"";
}

std::string csv_figure(const Figure& figure) {
  if (figure.is_word) return csv_word(figure.word);
  const Json value = exact(figure);
  return value.is_null() ? "" : dumped(value, -1);
}

Json to_json(const FigureTable& table) {
  Json json{{"title", table.title}, {"notes", table.notes}, {"rows", Json::array()}};
  for (const auto& figures : table.rows) {
    Json row = Json::object();
    for (std::size_t i = 0; i < figures.size(); ++i) row[table.columns[i].key] = exact(figures[i]);
    json["rows"].push_back(std::move(row));
  }
  return json;
}

}  // namespace

std::vector<std::vector<std::string>> table_words(const FigureTable& table) {
  std::vector<Row> rows(1);
  for (const FigureColumn& column : table.columns) rows[0].push_back(column.title);
  for (const auto& figures : table.rows) {
    rows.emplace_back();
    for (std::size_t i = 0; i < figures.size(); ++i)
      rows.back().push_back(rounded(figures[i], table.columns[i].decimals));
  }
  return rows;
}

std::string table_text(const FigureTable& table) {
  const std::vector<Row> rows = table_words(table);
  std::vector<std::string> lines(rows.size());
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::size_t width = 0;
    for (const Row& row : rows) width = std::max(width, row[column].size());
    const bool left = has_words(table, column);
    for (std::size_t i = 0; i < rows.size(); ++i)
      lines[i].append(column == 0 ? 0 : 2, ' ').append(padded(rows[i][column], width, left));
  }
  std::string text = table.title + "\n";
  for (const std::string& line : lines) text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  for (const std::string& note : table.notes) text += note + "\n";
  return text;
}

std::string table_markdown(const FigureTable& table) {
  const std::vector<Row> rows = table_words(table);
  std::string text = "**";
  text.append(markdown_word(table.title)).append("**\n\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += "|";
    for (const std::string& word : rows[i]) text.append(" ").append(markdown_word(word)).append(" |");
    text += "\n";
    if (i > 0) continue;
    text += "|";
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      text += has_words(table, column) ? "---|" : "--:|";
    text += "\n";
  }
  for (const std::string& note : table.notes) text.append("\n").append(markdown_word(note)).append("\n");
  return text;
}

std::string table_csv(const FigureTable& table) {
  std::string text;
  for (const FigureColumn& column : table.columns) text.append(text.empty() ? 0 : 1, ',').append(csv_word(column.key));
  text += "\n";
  for (const auto& figures : table.rows) {
    for (std::size_t i = 0; i < figures.size(); ++i) text.append(i == 0 ? 0 : 1, ',').append(csv_figure(figures[i]));
    text += "\n";
  }
  return text;
}

std::string tables_json(std::span<const std::string> names, std::span<const FigureTable> tables) {
  Json json = Json::object();
  for (std::size_t i = 0; i < tables.size(); ++i) json[names[i]] = to_json(tables[i]);
  return dumped(json, 2) + "\n";
}

}  // namespace tilth
