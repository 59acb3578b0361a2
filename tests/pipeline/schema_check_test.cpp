/// What a person is told of a document that a schema refuses.

#include "engine/pipeline/schema_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/pipeline/project.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;

Json project() {
  return Json::parse(R"({
    "format": "acentric-project", "version": 1, "scene": "room.glb",
    "storeys": [{"name": "floor", "layout": {"configuration": "b", "cellSize": 2}}]
  })");
}

TEST(SchemaCheck, SaysWhereAndWhatWouldBeRight) {
  struct Case {
    const char* pointer;
    Json value;
    const char* told;
  };
  const std::vector<Case> cases{
      {"/scene", 5, "/scene: must be a text in quotes, not 5"},
      {"/scene", "", "/scene: must have at least 1 characters, not 0"},
      {"/version", 7, "/version: must be 1, not 7"},
      {"/storeys", Json::array(), "/storeys: must have at least 1 entries, not 0"},
      {"/storeys", "one", "/storeys: must be a list, not \"one\""},
      {"/storeys/0/name", std::string(500, 'x'),
       "/storeys/0/name: must have at most 100 characters, not 500"},
      {"/storeys/0/layout/cellSize", -1, "/storeys/0/layout/cellSize: must be at least 0.0001, not -1"},
      {"/storeys/0/layout/cellSize", "2 m", "/storeys/0/layout/cellSize: must be a number, not \"2 m\""},
      {"/storeys/0/layout/configuration", "z",
       "/storeys/0/layout/configuration: must be one of \"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", not "
       "\"z\""},
      {"/storeys/0/layout/latticeOrigin", Json::array({1, 2, 3}),
       "/storeys/0/layout/latticeOrigin: must have 2 entries, not 3"},
      {"/storeys/0/layout/outline", Json::parse("[[[0, 0], [1, 0], [1, \"b\"]]]"),
       "/storeys/0/layout/outline/0/2/1: must be a number, not \"b\""},
      {"/bake", Json::object({{"maxLayers", 2.5}}), "/bake/maxLayers: must be a whole number, not 2.5"},
      {"/bake", Json::object({{"pruning", 1}}), "/bake/pruning: must be true or false, not 1"},
      {"/import", Json::object({{"unit", 1}}),
       "/import: has \"unit\", which is none of the fields here: metresPerUnit, up, defaultLight, lighting"},
      {"/layout", Json::object({{"configuration", "b"}, {"cellSize", 1}}),
       "/: must have just one of \"storeys\" and \"layout\""},
  };
  for (const Case& each : cases) {
    Json json = project();
    json[Json::json_pointer(each.pointer)] = each.value;
    const Status checked = checkSchema(json, projectSchema(), "walk.acentric.json");
    ASSERT_FALSE(checked) << each.told;
    EXPECT_EQ(checked.error().message, each.told);
    EXPECT_EQ(checked.error().kind, ErrorKind::malformed);
    EXPECT_THAT(checked.error().describe(), testing::HasSubstr("walk.acentric.json"));
  }
}

TEST(SchemaCheck, NamesWhatIsMissing) {
  Json json = project();
  json["storeys"][0]["layout"].erase("cellSize");
  EXPECT_EQ(checkSchema(json, projectSchema(), "").error().message, "/storeys/0/layout: has no \"cellSize\"");
  json = project();
  json.erase("storeys");
  EXPECT_EQ(checkSchema(json, projectSchema(), "").error().message,
            "/: must have just one of \"storeys\" and \"layout\"");
  EXPECT_EQ(checkSchema(Json::array(), projectSchema(), "").error().message, "/: must be an object, not []");
}

TEST(SchemaCheck, FallsBackOnTheValidatorsWords) {
  const Status checked = checkSchema(Json::parse("[1, 1]"), R"({"uniqueItems": true})", "");
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, testing::StartsWith("/"));
}

TEST(SchemaCheck, LetsSoundOnesPass) { EXPECT_TRUE(checkSchema(project(), projectSchema(), "")); }

}  // namespace
}  // namespace acentric
