#include "core/deck/grammar.hpp"

#include <muParser.h>

#include <string>

namespace beadwork {

// muParser finds the structure: precedence, brackets, arguments. It is run once, on handles instead of
// values: each number it sees is the index of a step, each operator and function a callback that checks the
// dimensions of its operands and records one more step. What is left is a straight list of steps.

namespace {

// ---- muParser calls plain functions, so they find the recorder here; set only while an expression is
// compiled.

thread_local StepRecorder* recording = nullptr;

template <Operation operation>
double record_unary(double a) {
  return recording->unary(operation, static_cast<int>(a));
}
template <Operation operation>
double record_binary(double a, double b) {
  return recording->binary(operation, static_cast<int>(a), static_cast<int>(b));
}
template <Operation operation>
double record_many(const double* handles, int count) {
  return recording->minimum_or_maximum(operation, handles, count);
}
double record_choice(double test, double yes, double no) {
  return recording->choose(static_cast<int>(test), static_cast<int>(yes), static_cast<int>(no));
}
double record_arc_tangent(double a, double b) {
  return recording->arc_tangent(static_cast<int>(a), static_cast<int>(b));
}
double record_plus(double a) { return recording->positive(static_cast<int>(a)); }

void define_operators(mu::Parser& parser) {
  using enum Operation;
  parser.EnableBuiltInOprt(false);
  parser.ClearInfixOprt();
  const auto operators = [&](const char* sign, mu::fun_type2 function, int precedence) {
    parser.DefineOprt(sign, function, static_cast<unsigned>(precedence), sign[0] == '^' ? mu::oaRIGHT : mu::oaLEFT);
  };
  operators("||", record_binary<either>, mu::prLOR);
  operators("&&", record_binary<both>, mu::prLAND);
  operators("<", record_binary<less>, mu::prCMP);
  operators("<=", record_binary<less_equal>, mu::prCMP);
  operators(">", record_binary<greater>, mu::prCMP);
  operators(">=", record_binary<greater_equal>, mu::prCMP);
  operators("==", record_binary<equal>, mu::prCMP);
  operators("!=", record_binary<different>, mu::prCMP);
  operators("+", record_binary<add>, mu::prADD_SUB);
  operators("-", record_binary<subtract>, mu::prADD_SUB);
  operators("*", record_binary<multiply>, mu::prMUL_DIV);
  operators("/", record_binary<divide>, mu::prMUL_DIV);
  operators("^", record_binary<power>, mu::prPOW);
  constexpr int below_comparison = (mu::prLAND + mu::prCMP) / 2;
  parser.DefineInfixOprt("!", record_unary<opposite>, below_comparison, false);
  parser.DefineInfixOprt("-", record_unary<negate>, mu::prINFIX, false);
  parser.DefineInfixOprt("+", record_plus, mu::prINFIX, false);
}

void define_functions(mu::Parser& parser) {
  using enum Operation;
  parser.ClearFun();
  const auto function = [&](const char* name, mu::fun_type1 callback) { parser.DefineFun(name, callback, false); };
  function("sqrt", record_unary<square_root>);
  function("abs", record_unary<absolute>);
  function("sin", record_unary<sine>);
  function("cos", record_unary<cosine>);
  function("tan", record_unary<tangent>);
  function("asin", record_unary<arc_sine>);
  function("acos", record_unary<arc_cosine>);
  function("atan", record_unary<arc_tangent>);
  function("exp", record_unary<exponential>);
  function("log", record_unary<logarithm>);
  function("ln", record_unary<logarithm>);
  function("log10", record_unary<logarithm_10>);
  function("floor", record_unary<Operation::floor>);
  function("ceil", record_unary<ceiling>);
  function("round", record_unary<Operation::round>);
  function("sign", record_unary<sign>);
  parser.DefineFun("atan2", record_arc_tangent, false);
  parser.DefineFun("if", record_choice, false);
  parser.DefineFun("min", record_many<minimum>, false);
  parser.DefineFun("max", record_many<maximum>, false);
}

std::string in_plain_words(const mu::ParserError& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF: return "the expression ends too early";
    case mu::ecUNASSIGNABLE_TOKEN:
    case mu::ecUNEXPECTED_OPERATOR: return "an operator cannot stand here";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN: return "an operator is missing before this";
    case mu::ecUNEXPECTED_PARENS: return "a bracket cannot stand here";
    case mu::ecMISSING_PARENS: return "a bracket is not closed";
    case mu::ecUNEXPECTED_ARG_SEP: return "a comma cannot stand here";
    case mu::ecTOO_MANY_PARAMS: return "this function has too many arguments";
    case mu::ecTOO_FEW_PARAMS: return "this function has too few arguments";
    default: return "cannot be understood";
  }
}

/// The tokens as muParser shall read them: leaves become constants v0 v1 ... that hold handles. `origin` tells for each
/// character which token it came from. muParser takes one sign before an operand: of several + and - one is left, and
/// what stands behind a `not` gets brackets.
class Translation {
 public:
  explicit Translation(const std::vector<Token>& tokens) : tokens_(tokens) {}

  std::string run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (const std::size_t next = behind_signs(i); next > i + 1) {
        emit(negates(i, next) ? "-" : "+", i);
        i = next - 1;
      } else {
        token(i);
      }
    }
    close_nots(tokens_.size() - 1);
    return std::move(text_);
  }

  std::vector<std::size_t> origin;

 private:
  bool is_sign(std::size_t i, std::string_view text) const {
    return i < tokens_.size() && tokens_[i].kind == Token::Kind::sign && tokens_[i].text == text;
  }
  bool is_plus_or_minus(std::size_t i) const { return is_sign(i, "+") || is_sign(i, "-"); }
  bool begins_operand(std::size_t i) const {
    return i == 0 || (tokens_[i - 1].kind == Token::Kind::sign && tokens_[i - 1].text != ")");
  }

  /// The first token behind the run of + and - before an operand that begins at i; i if there is none.
  std::size_t behind_signs(std::size_t i) const {
    if (!begins_operand(i)) return i;
    while (is_plus_or_minus(i)) ++i;
    return i;
  }

  bool negates(std::size_t begin, std::size_t end) const {
    bool negative = false;
    for (std::size_t i = begin; i < end; ++i) negative ^= tokens_[i].text == "-";
    return negative;
  }

  void emit(const std::string& text, std::size_t from) {
    text_ += text + ' ';
    origin.resize(text_.size(), from);
  }

  void token(std::size_t i) {
    const Token& token = tokens_[i];
    const bool ends = is_sign(i, "&&") || is_sign(i, "||") || is_sign(i, ",") || is_sign(i, ")");
    if (ends) close_nots(i);
    if (is_sign(i, "(")) ++depth_;
    if (is_sign(i, ")")) --depth_;
    if (token.kind == Token::Kind::function) {
      text_ += token.text;  // muParser wants the bracket right behind the name
      origin.resize(text_.size(), i);
    } else {
      emit(token.kind == Token::Kind::sign ? token.text : "v" + std::to_string(i), i);
    }
    if (!is_sign(i, "!") || !(is_sign(i + 1, "!") || is_plus_or_minus(i + 1)) || i + 2 == tokens_.size()) return;
    emit("(", i);
    nots_.push_back(depth_);
  }

  void close_nots(std::size_t from) {
    for (; !nots_.empty() && nots_.back() == depth_; nots_.pop_back()) emit(")", from);
  }

  const std::vector<Token>& tokens_;
  std::string text_;
  int depth_ = 0;
  std::vector<int> nots_;  // at which depth each bracket behind a `not` was opened
};

}  // namespace

int record(const std::vector<Token>& tokens, const std::vector<int>& handles, std::size_t text_length,
           StepRecorder& recorder) {
  recording = &recorder;
  Translation translation(tokens);
  const std::string text = translation.run();
  const std::vector<std::size_t>& origin = translation.origin;
  try {
    mu::Parser parser;
    define_operators(parser);
    define_functions(parser);
    parser.ClearConst();
    parser.EnableOptimizer(false);
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (handles[i] >= 0) parser.DefineConst("v" + std::to_string(i), handles[i]);
    parser.SetExpr(text);
    return static_cast<int>(parser.Eval());
  } catch (const mu::ParserError& error) {
    const auto position = static_cast<std::size_t>(error.GetPos());
    const bool is_known = position < origin.size() && error.GetCode() != mu::ecUNEXPECTED_EOF;
    throw ExpressionMistake(is_known ? tokens[origin[position]].at : text_length, in_plain_words(error));
  }
}

}  // namespace beadwork
