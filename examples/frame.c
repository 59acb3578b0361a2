/* Draws one frame of a bundle: frame BUNDLE OUT.ppm [X Y YAW_IN_DEGREES]
 *
 *   acentric export walk.acentric.json --to bundle walk-bundle
 *   cc frame.c $(pkg-config --cflags --libs acentric-runtime) -o frame
 *   ./frame walk-bundle frame.ppm
 */
#include <acentric_runtime.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(acentric_bundle* bundle, const char* what, acentric_status status) {
  fprintf(stderr, "%s: %s: %s\n", what, acentric_status_name(status), acentric_message(bundle));
  acentric_close(bundle);
  return 1;
}

static int write_ppm(const char* name, const unsigned char* rgba, int width, int height) {
  FILE* file = fopen(name, "wb");
  size_t i, count = (size_t)width * (size_t)height;
  if (file == NULL) return 0;
  fprintf(file, "P6\n%d %d\n255\n", width, height);
  for (i = 0; i < count; ++i) fwrite(rgba + 4 * i, 1, 3, file);
  return fclose(file) == 0;
}

int main(int argc, char** argv) {
  acentric_bundle* bundle = NULL;
  acentric_view view;
  acentric_picture picture = {NULL, 0, NULL, NULL};
  acentric_status status;
  int written;

  if (argc != 3 && argc != 6) {
    fprintf(stderr, "usage: %s BUNDLE OUT.ppm [X Y YAW_IN_DEGREES]\n", argv[0]);
    return 2;
  }
  status = acentric_open_folder(argv[1], &bundle);
  if (status != ACENTRIC_OK) return fail(bundle, argv[1], status);
  status = acentric_set_threads(bundle, 2);
  if (status != ACENTRIC_OK) return fail(bundle, "threads", status);

  status = acentric_start_view(bundle, &view);
  if (status != ACENTRIC_OK) return fail(bundle, "start", status);
  if (argc == 6) {
    view.eye[0] = atof(argv[3]);
    view.eye[1] = atof(argv[4]);
    view.yaw = atof(argv[5]) * 3.14159265358979323846 / 180;
  }
  status = acentric_load_view(bundle, &view, NULL, ACENTRIC_FULL);
  if (status != ACENTRIC_OK) return fail(bundle, "loading", status);

  picture.rgba = malloc((size_t)view.width * (size_t)view.height * 4);
  if (picture.rgba == NULL) return fail(bundle, "picture", ACENTRIC_ERROR_MEMORY);
  status = acentric_render(bundle, &view, NULL, &picture);
  if (status != ACENTRIC_OK) return fail(bundle, "drawing", status);
  written = write_ppm(argv[2], picture.rgba, view.width, view.height);
  if (!written) perror(argv[2]);
  printf("%s: %d x %d pixels, %.1f MB in memory\n", argv[2], view.width, view.height,
         (double)acentric_memory(bundle) / 1e6);
  free(picture.rgba);
  acentric_close(bundle);
  return written ? 0 : 1;
}
