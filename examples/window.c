/* Walks through a walk in a window, drawn by a program's own OpenGL: window FILE.acentric [OUT.ppm]
 * W, A, S, D walk; the mouse looks around while its button is held. With OUT.ppm the first frame that is
 * whole is written, and the program ends. Needs GLFW 3 and libepoxy. */
#include <epoxy/gl.h>
/* after it: */
#include <GLFW/glfw3.h>
#include <acentric_runtime.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char* const kShaders[2] = {
    "#version 330\n"
    "layout(location = 0) in vec3 position; layout(location = 1) in vec2 uv; layout(location = 2) in vec4 "
    "colour;\n"
    "uniform mat4 clip_from_model; out vec2 at; out vec4 tint;\n"
    "void main() { gl_Position = clip_from_model * vec4(position, 1); at = uv; tint = colour; }\n",
    "#version 330\n"
    "in vec2 at; in vec4 tint; out vec4 shown;\n"
    "uniform sampler2D picture; uniform vec4 factor; uniform float cutoff;\n"
    "void main() { shown = factor * texture(picture, at) * tint; if (shown.a < cutoff) discard; "
    "}\n"};

/* A model on the graphics card. */
typedef struct {
  acentric_arrival from;
  GLuint array, vertices, indices, *textures;
  long drawn; /* the last frame that showed it */
} drawable;
enum { kMost = 256, kKept = 1000 /* frames */, kTexturePixels = 4096 };
static drawable drawables[kMost];
static int drawable_count;

static void attribute(GLuint index, int values, GLenum type, size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, values, type, type == GL_UNSIGNED_SHORT, sizeof(acentric_model_vertex),
                        (const void*)offset);
}

static void send(drawable* to) {
  static const GLint kWraps[] = {GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT};
  const acentric_model* model = to->from.model;
  glGenVertexArrays(1, &to->array), glGenBuffers(1, &to->vertices), glGenBuffers(1, &to->indices);
  glBindVertexArray(to->array);
  glBindBuffer(GL_ARRAY_BUFFER, to->vertices), glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, to->indices);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(model->vertex_count * sizeof *model->vertices), model->vertices,
               GL_STATIC_DRAW);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(model->index_count * sizeof *model->indices),
               model->indices, GL_STATIC_DRAW);
  attribute(0, 3, GL_FLOAT, offsetof(acentric_model_vertex, position));
  attribute(1, 2, GL_FLOAT, offsetof(acentric_model_vertex, uv));
  attribute(2, 4, GL_UNSIGNED_SHORT, offsetof(acentric_model_vertex, colour));
  to->textures = calloc((size_t)model->texture_count, sizeof(GLuint));
  glGenTextures(model->texture_count, to->textures);
  for (int i = 0; i < model->texture_count; ++i) {
    const acentric_image* image = &model->textures[i];
    glBindTexture(GL_TEXTURE_2D, to->textures[i]);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image->width, image->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image->rgba);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, kWraps[image->wrap_u]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, kWraps[image->wrap_v]);
  }
}

static void drop(acentric_bundle* bundle, drawable* of) {
  glDeleteVertexArrays(1, &of->array), glDeleteBuffers(1, &of->vertices), glDeleteBuffers(1, &of->indices);
  glDeleteTextures(of->from.model->texture_count, of->textures), free(of->textures);
  acentric_return_model(bundle, &of->from);
  acentric_free_model(of->from.model);
  *of = drawables[--drawable_count];
}

/* What has come goes to the card. A full capture takes the place of the coarse one; what was not shown for
 * long goes. */
static void take_models(acentric_bundle* bundle, long frame) {
  drawable next = {{0}, 0, 0, 0, NULL, frame};
  while (drawable_count < kMost) {
    if (acentric_next_model(bundle, &next.from) != ACENTRIC_OK)
      fprintf(stderr, "%s\n", acentric_message(bundle));
    else if (next.from.model == NULL)
      break;
    else {
      for (int i = drawable_count - 1; i >= 0; --i)
        if (drawables[i].from.storey == next.from.storey && drawables[i].from.kind == next.from.kind &&
            drawables[i].from.number == next.from.number)
          drop(bundle, &drawables[i]);
      send(&next);
      drawables[drawable_count++] = next;
    }
  }
  for (int i = drawable_count - 1; i >= 0; --i)
    if (drawables[i].drawn < frame - kKept) drop(bundle, &drawables[i]);
}

static void draw_mesh(const acentric_mesh* mesh, GLuint texture, GLuint program) {
  (mesh->double_sided ? glDisable : glEnable)(GL_CULL_FACE);
  glUniform4fv(glGetUniformLocation(program, "factor"), 1, mesh->factor);
  glUniform1f(glGetUniformLocation(program, "cutoff"), mesh->alpha_cutoff);
  glBindTexture(GL_TEXTURE_2D, texture);
  glDrawElements(GL_TRIANGLES, (GLsizei)mesh->index_count, GL_UNSIGNED_INT,
                 (const void*)(size_t)(mesh->first_index * sizeof(uint32_t)));
}

static void draw(acentric_bundle* bundle, const acentric_view* view, GLuint program, long frame) {
  acentric_need needs[kMost];
  acentric_needs all = {0};
  acentric_view_needs(bundle, view, NULL, needs, kMost, &all);
  for (int blended = 0; blended < 2; ++blended) { /* over all that is not */
    (blended ? glEnable : glDisable)(GL_BLEND);
    glDepthMask(!blended);
    for (size_t n = 0; n < all.count && n < kMost; ++n)
      for (drawable* d = drawables; d < drawables + drawable_count; ++d) {
        float matrix[16];
        if (d->from.storey != all.storey || d->from.kind != needs[n].kind ||
            d->from.number != needs[n].number)
          continue;
        d->drawn = frame;
        acentric_clip_from_model(view, d->from.model->origin, 0.1, matrix);
        glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_model"), 1, GL_FALSE, matrix);
        glBindVertexArray(d->array);
        for (int i = 0; i < d->from.model->mesh_count; ++i) {
          const acentric_mesh* m = &d->from.model->meshes[i];
          if ((m->roles & needs[n].roles) != 0 && (m->alpha_mode == ACENTRIC_BLEND) == blended)
            draw_mesh(m, d->textures[m->texture], program);
        }
      }
  }
  glDepthMask(GL_TRUE);
}

/* Moves the eye as keys and mouse say; it stays where one may stand. */
static void steer(GLFWwindow* window, acentric_bundle* bundle, acentric_view* view, double metres) {
  static double x, y;
  const double ahead = metres * (glfwGetKey(window, GLFW_KEY_W) - glfwGetKey(window, GLFW_KEY_S));
  const double right = metres * (glfwGetKey(window, GLFW_KEY_D) - glfwGetKey(window, GLFW_KEY_A));
  const double old_x = x, old_y = y, per_pixel = view->fov / view->width;
  int32_t storey = 0;
  glfwGetCursorPos(window, &x, &y);
  if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
    view->yaw += (x - old_x) * per_pixel;
    view->pitch = fmax(-1.4, fmin(1.4, view->pitch + (y - old_y) * per_pixel));
  }
  view->eye[0] += ahead * cos(view->yaw) + right * sin(view->yaw);
  view->eye[1] += ahead * sin(view->yaw) - right * cos(view->yaw);
  acentric_storey_at(bundle, view->eye, &storey);
  acentric_clamp(bundle, storey, view->eye);
}

static int write_ppm(const char* name, int width, int height) {
  static unsigned char row[3 * 16384];
  FILE* file = fopen(name, "wb");
  if (file == NULL) return 0;
  fprintf(file, "P6\n%d %d\n255\n", width, height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (int y = height; y-- > 0; fwrite(row, 3, (size_t)width, file))
    glReadPixels(0, y, width, 1, GL_RGB, GL_UNSIGNED_BYTE, row);
  return fclose(file) == 0;
}

int main(int argc, char** argv) {
  acentric_bundle* bundle = NULL;
  acentric_view view;
  double before = 0, now;
  if (argc < 2 || acentric_open_walk(argv[1], &bundle) != ACENTRIC_OK)
    return fprintf(stderr, "usage: %s FILE.acentric [OUT.ppm]\n%s\n", argv[0], acentric_message(bundle)), 1;
  acentric_set_threads(bundle, 4);
  acentric_start_view(bundle, &view);
  glfwInit();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3), glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE), glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
  GLFWwindow* window = glfwCreateWindow(view.width, view.height, argv[1], NULL, NULL);
  if (window == NULL) return fprintf(stderr, "no window with OpenGL 3.3\n"), 1;
  glfwMakeContextCurrent(window);
  const GLuint program = glCreateProgram();
  for (int i = 0; i < 2; ++i) {
    GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    glShaderSource(shader, 1, &kShaders[i], NULL);
    glCompileShader(shader), glAttachShader(program, shader);
  }
  glLinkProgram(program), glUseProgram(program);
  glEnable(GL_DEPTH_TEST), glEnable(GL_FRAMEBUFFER_SRGB), glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  for (long frame = 1; !glfwWindowShouldClose(window); ++frame, before = now) {
    glfwPollEvents(), now = glfwGetTime();
    glfwGetFramebufferSize(window, &view.width, &view.height);
    steer(window, bundle, &view, 1.4 * (now - before));
    acentric_request_models(bundle, &view, NULL, kTexturePixels);
    take_models(bundle, frame);
    glViewport(0, 0, view.width, view.height), glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(bundle, &view, program, frame);
    if (argc > 2 && acentric_waiting(bundle) == 0) return write_ppm(argv[2], view.width, view.height) ? 0 : 1;
    glfwSwapBuffers(window);
  }
  while (drawable_count > 0) drop(bundle, &drawables[0]);
  acentric_close(bundle);
  glfwTerminate();
  return 0;
}
