// Finds the functions of a C++ file by their braces: name, lines, parameters, nesting. It reads the formatted code of
// this house, not every C++ there is; what a macro hides it does not see. O(characters).
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace tilth::house {

struct FunctionText {
  std::string head;       ///< all before its opening brace
  std::size_t line = 0;   ///< of the opening brace, from 1
  std::size_t lines = 0;  ///< head and body
  std::size_t parameters = 0;
  std::size_t nesting = 0;  ///< control blocks within one another
};

namespace scanner {

/// The text with comments, literals and preprocessor lines blanked, newlines kept.
inline std::string without_literals(const std::string& text) {
  std::string out = text;
  const auto blank = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, out.size()); ++i) {
      if (out[i] != '\n') out[i] = ' ';
    }
    return to;
  };
  for (std::size_t i = 0; i < text.size();) {
    const bool line_begin = i == 0 || text[i - 1] == '\n';
    if (text.compare(i, 2, "//") == 0 || (line_begin && text[i] == '#')) {
      i = blank(i, text.find('\n', i));
    } else if (text.compare(i, 2, "/*") == 0) {
      i = blank(i, text.find("*/", i) + 2);
    } else if (text.compare(i, 2, "R\"") == 0) {
      std::string end(")");
      end.append(text, i + 2, text.find('(', i) - i - 2).append("\"");
      i = blank(i, text.find(end, i) + end.size());
    } else if (text[i] == '"' ||
               (text[i] == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
      i = blank(i, end + 1);
    } else {
      ++i;
    }
  }
  return out;
}

/// The index just past the bracket that closes the one at `open`.
inline std::size_t past_match(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (std::string("([{").find(text[i]) != std::string::npos) ++depth;
    if (std::string(")]}").find(text[i]) != std::string::npos && --depth == 0) return i + 1;
  }
  return text.size();
}

inline bool has_word(const std::string& text, const std::string& word) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) {
    const std::size_t end = i + word.size();
    if ((i == 0 || !in_word(text[i - 1])) && (end == text.size() || !in_word(text[end]))) return true;
  }
  return false;
}

inline std::size_t count_parameters(const std::string& head) {
  std::size_t open = head.find('(');
  if (head.compare(open, 3, "()(") == 0) open += 2;  // operator()
  const std::string list = head.substr(open + 1, past_match(head, open) - open - 2);
  if (list.find_first_not_of(" \n") == std::string::npos) return 0;
  int depth = 0;
  std::size_t count = 1;
  for (const char c : list) {
    if (std::string("([{<").find(c) != std::string::npos) ++depth;
    if (std::string(")]}>").find(c) != std::string::npos) --depth;
    if (c == ',' && depth == 0) ++count;
  }
  return count;
}

/// Whether what stands before a brace is if, for, while ... and not, say, a lambda among the arguments of a call.
inline bool is_control(const std::string& head) {
  if (std::count(head.begin(), head.end(), '(') != std::count(head.begin(), head.end(), ')')) return false;
  for (const char* word : {"if", "else", "for", "while", "do", "switch", "try", "catch"}) {
    if (has_word(head, word)) return true;
  }
  return false;
}

/// How deep if, for, while, do, switch and try blocks stand within one another.
inline std::size_t nesting_of(const std::string& body) {
  struct Block {
    bool control = false;
    int parentheses = 0;  // open within the block
  };
  std::vector<Block> blocks(1);
  std::size_t begin = 1, deepest = 0;
  for (std::size_t i = 1; i + 1 < body.size(); ++i) {
    const char c = body[i];
    if (c == '(') ++blocks.back().parentheses;
    if (c == ')') --blocks.back().parentheses;
    if (c == '{') {
      blocks.push_back({is_control(body.substr(begin, i - begin)), 0});
      const auto depth = std::count_if(blocks.begin(), blocks.end(), [](const Block& b) { return b.control; });
      deepest = std::max(deepest, std::size_t(depth));
    }
    if (c == '}') blocks.pop_back();
    if (c == '{' || c == '}' || (c == ';' && blocks.back().parentheses == 0)) begin = i + 1;
  }
  return deepest;
}

/// Whether the brace at the end of `head` opens a member's initialiser, `: stride_{4}`, and no body yet.
inline bool in_initialiser_list(const std::string& head) {
  const std::size_t list = head.find(") :");
  const std::size_t last = head.find_last_not_of(" \n");
  return list != std::string::npos && (std::isalnum(static_cast<unsigned char>(head[last])) || head[last] == '_');
}

}  // namespace scanner

inline std::vector<FunctionText> functions_of(const std::string& source) {
  using namespace scanner;
  const std::string text = without_literals(source);
  std::vector<FunctionText> functions;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ';' || text[i] == '}') begin = i + 1;
    if (text[i] != '{') continue;
    const std::size_t first = text.find_first_not_of(" \n", begin);
    const std::string head = text.substr(first, i - first);
    if (in_initialiser_list(head)) {
      i = past_match(text, i) - 1;
    } else if (head.find('(') != std::string::npos && head.find(" = ") > head.find('(')) {
      const std::size_t end = past_match(text, i);
      const auto lines = std::size_t(std::count(text.begin() + long(first), text.begin() + long(end), '\n')) + 1;
      const auto line = std::size_t(std::count(text.begin(), text.begin() + long(i), '\n')) + 1;
      functions.push_back({head, line, lines, count_parameters(head), nesting_of(text.substr(i, end - i))});
      begin = end;
      i = end - 1;
    } else if (!has_word(head, "namespace") && !has_word(head, "struct") && !has_word(head, "class")) {
      i = past_match(text, i) - 1;  // an initialiser or an enum
    } else {
      begin = i + 1;
    }
  }
  return functions;
}

}  // namespace tilth::house
