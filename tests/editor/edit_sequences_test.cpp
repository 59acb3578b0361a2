/// Any sequence of edits can be undone completely and done again, and every project on the way survives its
/// file.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "editor/session/history.h"
#include "editor/session/project_size.h"
#include "tests/editor/edit_generator.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

Project firstProject() {
  Project project;
  project.scene = "room.obj";
  project.layout().outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  project.layout().cellSize = 1.5;
  for (const char* name : {"gallery", "roof"}) {
    Storey storey = project.storeys.front();
    storey.name = name;
    storey.layout.floorHeight += 3.0 * double(project.storeys.size());
    project.storeys.push_back(storey);
  }
  return project;
}

/// What a session does with edits, beside a plain list of what the history should hold.
class Sequence {
 public:
  explicit Sequence(unsigned seed)
      : random_(seed), history_(firstProject(), true), expected_{firstProject()} {}

  void step() {
    switch (random_() % 8) {
      case 0:
        return undo();
      case 1:
        return redo();
      case 2:
        return drag();
      case 3:
        return jump();
      default:
        return edit();
    }
  }
  /// Told with a failure.
  const std::string& told() const { return told_; }
  History& history() { return history_; }
  const std::vector<Project>& expected() const { return expected_; }
  std::size_t cursor() const { return cursor_; }

 private:
  std::optional<Edit> sound() {
    const auto& commands = generatedCommands();
    const GeneratedCommand& command = commands[random_() % commands.size()];
    Edit edit = command.make(history_.current(), random_);
    const bool passes = edit.project.check().has_value();
    told_ += std::string(" ") + command.name + (passes ? "" : "(refused)");
    return passes ? std::optional(std::move(edit)) : std::nullopt;
  }
  void expect(const Project& project) {
    if (project == expected_[cursor_]) return;
    expected_.resize(cursor_ + 1);
    expected_.push_back(project);
    ++cursor_;
  }
  void edit() {
    if (auto edit = sound()) {
      expect(edit->project);
      history_.push(std::move(edit->project), std::move(edit->label));
    }
  }
  void drag() {
    told_ += " [";
    std::optional<Project> last;
    for (unsigned i = 1 + random_() % 4; i > 0; --i)
      if (auto edit = sound()) {
        last = edit->project;
        history_.preview(std::move(edit->project), std::move(edit->label));
      }
    const bool keep = random_() % 2 == 0;
    told_ += keep ? " ]" : " ]rolled-back";
    keep ? history_.commitPreview() : history_.rollbackPreview();
    if (keep && last) expect(*last);
  }
  void undo() {
    told_ += " UNDO";
    if (cursor_ > 0) --cursor_;
    history_.undo();
  }
  void redo() {
    told_ += " REDO";
    if (cursor_ + 1 < expected_.size()) ++cursor_;
    history_.redo();
  }
  void jump() {
    cursor_ = random_() % expected_.size();
    told_ += " GOTO" + std::to_string(cursor_);
    history_.goTo(cursor_);
  }

  Random random_;
  History history_;
  std::vector<Project> expected_;
  std::size_t cursor_ = 0;
  std::string told_;
};

TEST(EditSequences, AreUndoneToTheFirstProjectAndDoneAgainToTheLastExactly) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Sequence sequence(seed);
    for (int step = 0; step < 60; ++step) {
      sequence.step();
      ASSERT_EQ(sequence.history().current(), sequence.expected()[sequence.cursor()])
          << "seed " << seed << ":" << sequence.told();
      ASSERT_EQ(sequence.history().cursor(), sequence.cursor()) << "seed " << seed << ":" << sequence.told();
    }
    History& history = sequence.history();
    while (history.canRedo()) history.redo();
    ASSERT_EQ(history.current(), sequence.expected().back()) << "seed " << seed << ":" << sequence.told();
    for (std::size_t back = sequence.expected().size(); back-- > 1;) {
      history.undo();
      ASSERT_EQ(history.current(), sequence.expected()[back - 1])
          << "seed " << seed << ":" << sequence.told();
    }
    ASSERT_EQ(history.current(), firstProject()) << "seed " << seed << ":" << sequence.told();
    ASSERT_FALSE(history.canUndo());
    ASSERT_FALSE(history.dirty()) << "as it was saved";
    while (history.canRedo()) history.redo();
    ASSERT_EQ(history.current(), sequence.expected().back()) << "seed " << seed << ":" << sequence.told();
  }
}

TEST(EditSequences, GiveProjectsThatSurviveTheirFileUnchanged) {
  for (unsigned seed = 101; seed <= 130; ++seed) {
    Sequence sequence(seed);
    for (int step = 0; step < 40; ++step) sequence.step();
    for (const Project& project : sequence.expected()) {
      const std::string text = formatProject(project);
      const auto read = parseProject(text, "memory");
      ASSERT_TRUE(read.has_value()) << read.error().describe() << "\nseed " << seed << ":" << sequence.told();
      ASSERT_EQ(*read, project) << "seed " << seed << ":" << sequence.told() << "\n"
                                << text << "\nread back:\n"
                                << formatProject(*read);
    }
  }
}

TEST(EditSequences, KnowEveryCommandThatThereIs) {
  std::set<std::string> generated;
  for (const GeneratedCommand& command : generatedCommands()) generated.insert(command.name);
  EXPECT_EQ(generated.size(), generatedCommands().size()) << "two of them have one name";
  std::set<std::string> declared;
  for (const auto& entry : fs::directory_iterator(ACENTRIC_COMMANDS_FOLDER)) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      for (const std::string_view result : {"Edit ", "std::optional<Edit> ", "Result<Edit> ", "GroupEdit "})
        if (const auto end = line.find('('); line.starts_with(result) && end != std::string::npos)
          declared.insert(line.substr(result.size(), end - result.size()));
  }
  ASSERT_GT(declared.size(), 20U);
  for (const std::string& name : declared)
    EXPECT_TRUE(generated.contains(name))
        << "editor/commands declares " << name
        << ": add it to generatedCommands() in tests/editor/edit_generator.cpp";
  for (const std::string& name : generated)
    EXPECT_TRUE(declared.contains(name)) << name << " is no command any more";
}

TEST(EditSequences, EveryCommandChangesSomethingNowAndThen) {
  Random random(7);
  Project project = firstProject();
  for (Storey& storey : project.storeys) storey.layout.configuration = Configuration::e;
  std::set<std::string> effective;
  for (int i = 0; i < 4000; ++i) {
    const auto& commands = generatedCommands();
    const GeneratedCommand& command = commands[random() % commands.size()];
    const Edit edit = command.make(project, random);
    if (!edit.project.check() || edit.project == project) continue;
    effective.insert(command.name);
    if (random() % 3 == 0 && command.name != std::string("removeStorey") &&
        command.name != std::string("setConfiguration"))
      project = edit.project;
  }
  for (const GeneratedCommand& command : generatedCommands())
    EXPECT_TRUE(effective.contains(command.name)) << command.name;
}

TEST(History, GoesToAnyEntryAndBack) {
  History history(firstProject(), true);
  std::vector<Project> projects{firstProject()};
  for (int i = 1; i < 8; ++i) {
    Project project = projects.back();
    project.fovDegrees = 60 + i;
    history.push(project, std::to_string(i));
    projects.push_back(project);
  }
  for (const std::size_t entry : {3U, 7U, 0U, 5U}) {
    history.goTo(entry);
    EXPECT_EQ(history.cursor(), entry);
    EXPECT_EQ(history.current(), projects[entry]);
    EXPECT_EQ(history.size(), 8U) << "nothing is forgotten by looking back";
  }
  EXPECT_EQ(history.find(projects[6]), 6U);
  EXPECT_FALSE(history.find(Project()).has_value());
  history.goTo(2);
  history.push(projects[7], "new");
  EXPECT_EQ(history.size(), 4U);
}

Project withCells(int cells) {
  Project project = firstProject();
  for (int i = 0; i < cells; ++i) project.layout().removed.insert({i, 0, 0});
  return project;
}

TEST(History, KeepsToItsMemoryAndDropsTheOldestFirst) {
  const std::size_t each = approximateBytes(withCells(1000));
  History history(withCells(1000), true, 5 * each + each / 2);
  for (int i = 1; i <= 12; ++i) history.push(withCells(1000 + i), std::to_string(i));
  EXPECT_EQ(history.size(), 5U);
  EXPECT_EQ(history.dropped(), 8U);
  EXPECT_LE(history.bytes(), 5 * each + each / 2);
  EXPECT_EQ(history.label(0), "8");
  while (history.canUndo()) history.undo();
  EXPECT_EQ(history.current(), withCells(1008));
  history.setMostBytes(1);
  EXPECT_EQ(history.size(), 5U) << "nothing at or behind the current entry is dropped";
  while (history.canRedo()) history.redo();
  history.setMostBytes(1);
  EXPECT_EQ(history.size(), 2U) << "the last edit can always be taken back";
  history.undo();
  EXPECT_EQ(history.current(), withCells(1011));
}

TEST(History, ARolledBackDragAtTheLimitLosesNothing) {
  const std::size_t each = approximateBytes(withCells(100));
  History history(withCells(100), true, 3 * each + each / 2);
  history.push(withCells(101), "1");
  history.push(withCells(102), "2");
  history.preview(withCells(500), "drag");
  history.rollbackPreview();
  EXPECT_EQ(history.size(), 3U);
  EXPECT_EQ(history.dropped(), 0U);
}

TEST(ProjectSize, GrowsWithCellsAndOutlines) {
  const Project small = withCells(0);
  Project outlined = small;
  outlined.layout().outline.loops.front().resize(1000);
  EXPECT_GE(approximateBytes(outlined), approximateBytes(small) + 990 * sizeof(glm::dvec2));
  EXPECT_GE(approximateBytes(withCells(10'000)), approximateBytes(small) + 10'000 * sizeof(CellId));
}

}  // namespace
}  // namespace acentric::editor
