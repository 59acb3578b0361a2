/* Walks through bundles that Acentric writes (acentric export P --to bundle FOLDER), for programs in C and
 * whatever calls C.
 *
 * Positions are metres, Z up, relative to acentric_info.origin. Angles are radians; azimuths and yaw run
 * counter-clockwise seen from above from +X, pitch upwards. Storeys, cameras, regions, bookmarks, paths,
 * textures, materials and mirrors are numbered from 0.
 *
 * Errors are returned as codes; acentric_message() says more, until the next call on the same handle.
 * No function throws, exits, prints, or keeps state outside of its handle. A handle is used by one thread at
 * a time; different handles know nothing of each other. Every function takes NULL for a handle, and answers
 * ACENTRIC_ERROR_ARGUMENT then (or 0, or NULL).
 *
 * Strings and arrays that are given out live as long as the handle; those of a capture's, a region's or a
 * texture's data until it is unloaded. A closed handle must not be used.
 *
 * Of a bundle's folder, and of a caller's files, the whole index is read when it is opened; of a walk only
 * pages of it, when they are needed. What is asked by a place or a view reads the page of that place; what is
 * asked by a number is answered from pages that were read, or looks through those that were not until one
 * tells of it, each once. A page that is damaged or cannot be read is an error of the call that needed it,
 * and the message names it; all else goes on. What is loaded stays when the eye comes to another page. */
#ifndef ACENTRIC_RUNTIME_H
#define ACENTRIC_RUNTIME_H

#include <stddef.h>
#include <stdint.h>

#define ACENTRIC_RUNTIME_VERSION_MAJOR 1
#define ACENTRIC_RUNTIME_VERSION_MINOR 2
#define ACENTRIC_RUNTIME_VERSION_PATCH 0
#define ACENTRIC_RUNTIME_VERSION                                                   \
  (ACENTRIC_RUNTIME_VERSION_MAJOR * 10000 + ACENTRIC_RUNTIME_VERSION_MINOR * 100 + \
   ACENTRIC_RUNTIME_VERSION_PATCH)

#if defined(__GNUC__)
#define ACENTRIC_API __attribute__((visibility("default")))
#else
#define ACENTRIC_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Of the library that runs: as ACENTRIC_RUNTIME_VERSION. The same major number has the same interface. */
ACENTRIC_API uint32_t acentric_runtime_version(void);

typedef int32_t acentric_status;
enum {
  ACENTRIC_OK = 0,
  ACENTRIC_ERROR_ARGUMENT = 1,    /* NULL, a number or name out of range */
  ACENTRIC_ERROR_NOT_FOUND = 2,   /* no such file, or a camera that was not baked */
  ACENTRIC_ERROR_UNREADABLE = 3,  /* a file is there and cannot be read */
  ACENTRIC_ERROR_MALFORMED = 4,   /* a file is damaged, or no bundle's */
  ACENTRIC_ERROR_UNSUPPORTED = 5, /* of a version that this library does not read */
  ACENTRIC_ERROR_MEMORY = 6,      /* beyond the memory limit, or the machine's */
  ACENTRIC_ERROR_OUTSIDE = 7,     /* the eye stands in no region: acentric_clamp moves it into one */
  ACENTRIC_ERROR_NOT_LOADED = 8,  /* data of what is not in memory */
  ACENTRIC_ERROR_INTERNAL = 9
};
/* "not found"; of an unknown number "unknown". Never NULL. */
ACENTRIC_API const char* acentric_status_name(acentric_status status);

/* --- Opening --- */

typedef struct acentric_bundle acentric_bundle;

/* Files by their names in the bundle, such as "captures/KEY.pack". Called from the thread that calls the
 * library, while it does; after acentric_request_view or acentric_request_models also from threads of the
 * library's own, several at once, until the handle is closed. `user` is handed on. Both return ACENTRIC_OK or
 * an error. */
typedef struct acentric_files {
  void* user;
  acentric_status (*size)(void* user, const char* name, uint64_t* bytes);
  acentric_status (*read)(void* user, const char* name, void* into, uint64_t bytes); /* the whole file */
} acentric_files;

/* Reads the index; captures and regions come when they are asked for. *bundle is a handle even where this
 * fails, unless memory is out or `bundle` is NULL: to ask it for its message, and to be closed. */
ACENTRIC_API acentric_status acentric_open_folder(const char* folder, acentric_bundle** bundle);
/* `files` is copied. */
ACENTRIC_API acentric_status acentric_open_files(const acentric_files* files, acentric_bundle** bundle);
/* A walk: a bundle as one file (`acentric export --to walk`). Reads the root of its index. */
ACENTRIC_API acentric_status acentric_open_walk(const char* file, acentric_bundle** bundle);

/* The same file wherever it is, such as behind HTTP range requests. Called as acentric_files are. */
typedef struct acentric_ranges {
  void* user;
  acentric_status (*size)(void* user, uint64_t* bytes);
  acentric_status (*read)(void* user, uint64_t offset, void* into, uint64_t bytes); /* all of them */
} acentric_ranges;
/* `ranges` is copied. */
ACENTRIC_API acentric_status acentric_open_ranges(const acentric_ranges* ranges, acentric_bundle** bundle);
ACENTRIC_API void acentric_close(acentric_bundle* bundle);
/* What was wrong with the last call that failed: file, place in it, reason. "" if none was. Never NULL. */
ACENTRIC_API const char* acentric_message(const acentric_bundle* bundle);
/* Threads that draw and unpack, 1 at first. As many load in the background, from its first request on. */
ACENTRIC_API acentric_status acentric_set_threads(acentric_bundle* bundle, int32_t threads);

/* --- What there is --- */

enum {
  ACENTRIC_LAYERED = 1,    /* several samples in a pixel */
  ACENTRIC_BLENDED = 2,    /* alpha below 1 */
  ACENTRIC_MIRRORS = 4,    /* reflections */
  ACENTRIC_BACKGROUND = 8, /* runs of the background */
  ACENTRIC_LIGHT = 16      /* baked to near surfaces */
};

typedef struct acentric_info {
  const char* name;
  const char* generator;
  double origin[3];
  double bounds_min[3], bounds_max[3];                /* all 0 of an empty scene */
  float sky_zenith[3], sky_horizon[3], sky_ground[3]; /* linear radiance */
  float exposure;
  uint32_t features; /* ACENTRIC_LAYERED | ... */
  double fov;        /* horizontal, that the walk begins with */
  int32_t storeys, start_storey, bookmarks, paths, textures, materials, mirrors;
} acentric_info;
ACENTRIC_API acentric_status acentric_get_info(acentric_bundle* bundle, acentric_info* info);

typedef struct acentric_storey {
  const char* name;
  double floor_height, eye_height, eye_z, near_band;
  double start[2], start_yaw;
  int32_t cameras, regions;
} acentric_storey;
ACENTRIC_API acentric_status acentric_get_storey(acentric_bundle* bundle, int32_t storey,
                                                 acentric_storey* out);

typedef struct acentric_rendition {
  int32_t columns, rows; /* 0 where there is none */
  uint64_t samples, reflections, file_bytes;
} acentric_rendition;
typedef struct acentric_camera {
  double position[2], low_azimuth, fov, top_elevation, bottom_elevation;
  acentric_rendition full, coarse;
} acentric_camera;
ACENTRIC_API acentric_status acentric_get_camera(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                                 acentric_camera* out);

enum { ACENTRIC_RING = 0, ACENTRIC_GAP_TRIANGLE = 1, ACENTRIC_GAP_SQUARE = 2, ACENTRIC_GAP_HEXAGON = 3 };
typedef struct acentric_region {
  int32_t kind, corners, grown_corners, neighbour_count;
  const double* polygon;          /* corners x, y: convex, counter-clockwise */
  const double* grown;            /* by the near band */
  const int32_t* neighbours;      /* that touch it */
  uint64_t triangles, file_bytes; /* of its near geometry */
} acentric_region;
ACENTRIC_API acentric_status acentric_get_region(acentric_bundle* bundle, int32_t storey, int32_t region,
                                                 acentric_region* out);

typedef struct acentric_pose {
  double eye[3], yaw, pitch, seconds;
} acentric_pose;
typedef struct acentric_bookmark {
  const char* name;
  int32_t storey;
  acentric_pose pose; /* seconds: 0 */
  double fov;
} acentric_bookmark;
ACENTRIC_API acentric_status acentric_get_bookmark(acentric_bundle* bundle, int32_t bookmark,
                                                   acentric_bookmark* out);
typedef struct acentric_path {
  const char* name;
  int32_t storey, count;
  const acentric_pose* poses;
} acentric_path;
ACENTRIC_API acentric_status acentric_get_path(acentric_bundle* bundle, int32_t path, acentric_path* out);

/* The storey whose regions are nearest to the eye. */
ACENTRIC_API acentric_status acentric_storey_at(acentric_bundle* bundle, const double eye[3],
                                                int32_t* storey);
/* The region that holds a place; ACENTRIC_ERROR_OUTSIDE and -1 if none does. */
ACENTRIC_API acentric_status acentric_region_at(acentric_bundle* bundle, int32_t storey,
                                                const double place[2], int32_t* region);
/* Moves a place that no region holds to the nearest that one does. */
ACENTRIC_API acentric_status acentric_clamp(acentric_bundle* bundle, int32_t storey, double place[2]);

/* --- Views --- */

typedef struct acentric_view {
  double eye[3], yaw, pitch, fov; /* fov: horizontal */
  int32_t width, height;          /* pixels, 1 to 16384 */
} acentric_view;
/* Where the walk begins, 960 x 540. */
ACENTRIC_API acentric_status acentric_start_view(acentric_bundle* bundle, acentric_view* view);

enum { ACENTRIC_LIST = 0, ACENTRIC_SCALAR = 1, ACENTRIC_ZBUFFER = 2 };
enum {
  ACENTRIC_POINT = 0,
  ACENTRIC_SPLAT = 1,
  ACENTRIC_PATCHES = 4 /* so are 2 and 3, of earlier versions */
};
typedef struct acentric_settings {
  int32_t renderer;         /* list priority, its plain reference, or a depth buffer */
  int32_t reconstruction;   /* how samples become pixels */
  int32_t max_splat_pixels; /* 1 to 64 */
  int32_t local_geometry;   /* the rest: 0 or 1 */
  int32_t secondary_cover, fill_holes;
} acentric_settings;
/* As the project has them. */
ACENTRIC_API acentric_status acentric_default_settings(acentric_bundle* bundle, acentric_settings* settings);

enum { ACENTRIC_CAPTURE = 0, ACENTRIC_REGION = 1 };
enum { ACENTRIC_ABSENT = 0, ACENTRIC_COARSE = 1, ACENTRIC_FULL = 2 };
typedef struct acentric_need {
  int32_t kind;   /* ACENTRIC_CAPTURE or ACENTRIC_REGION */
  int32_t number; /* of the camera or region */
  int32_t loaded; /* ACENTRIC_ABSENT, _COARSE, _FULL; a region is absent or full */
  /* Of a capture: the region draws the samples and runs that share a bit with these; of a region all bits. */
  uint32_t roles;
} acentric_need;
typedef struct acentric_needs {
  int32_t storey, region; /* where the eye stands */
  size_t count;           /* of all needs, however many fit */
} acentric_needs;
/* What a view is drawn from in drawing order: captures back to front, then the region's near geometry. The
 * first `capacity` are written to `list` (NULL if 0). `settings`: NULL for the project's, as everywhere. */
ACENTRIC_API acentric_status acentric_view_needs(acentric_bundle* bundle, const acentric_view* view,
                                                 const acentric_settings* settings, acentric_need* list,
                                                 size_t capacity, acentric_needs* needs);

/* --- Memory --- */

/* Of captures, regions and textures in memory. */
ACENTRIC_API uint64_t acentric_memory(const acentric_bundle* bundle);
/* Loading beyond it fails, and leaves what is there; 0 = no limit, as at first. */
ACENTRIC_API acentric_status acentric_set_memory_limit(acentric_bundle* bundle, uint64_t bytes);
/* `detail`: ACENTRIC_COARSE or ACENTRIC_FULL; both of a camera may be loaded, the full one is drawn. What is
 * loaded stays as it is; unloading what is not is no error. */
ACENTRIC_API acentric_status acentric_load_capture(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                                   int32_t detail);
ACENTRIC_API acentric_status acentric_unload_capture(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                                     int32_t detail);
/* With the textures that it needs, which stay until acentric_unload_textures. */
ACENTRIC_API acentric_status acentric_load_region(acentric_bundle* bundle, int32_t storey, int32_t region);
ACENTRIC_API acentric_status acentric_unload_region(acentric_bundle* bundle, int32_t storey, int32_t region);
ACENTRIC_API acentric_status acentric_unload_textures(acentric_bundle* bundle);
/* All that a view needs: full captures, or with ACENTRIC_COARSE coarse ones where nothing is loaded yet. A
 * camera that was not baked is left out, one that has no such rendition gives its other. */
ACENTRIC_API acentric_status acentric_load_view(acentric_bundle* bundle, const acentric_view* view,
                                                const acentric_settings* settings, int32_t detail);

/* --- Loading in the background (since 1.2) --- */

/* As acentric_load_view, but at once: threads of the library's own read and unpack, captures that are nearest
 * first. Of cameras of which nothing is loaded the coarse capture comes first, whatever `detail`. Each
 * request takes the place of the one before; what is being read then is still finished. What could not be
 * read is not tried again until acentric_cancel. Call it whenever the eye has moved, such as in each frame:
 * of a walk it reads the page of the index where the eye is before it returns, but pages that the eye comes
 * near to are read in the background beforehand. */
ACENTRIC_API acentric_status acentric_request_view(acentric_bundle* bundle, const acentric_view* view,
                                                   const acentric_settings* settings, int32_t detail);
/* Takes what has come: it is loaded then. Never waits. An error is of one file; call it again for the rest.
 * *arrived, unless NULL: how many came. */
ACENTRIC_API acentric_status acentric_poll(acentric_bundle* bundle, int32_t* arrived);
/* Drops what was requested and not begun, and forgets what failed. */
ACENTRIC_API acentric_status acentric_cancel(acentric_bundle* bundle);
/* How much was requested and has not been taken by acentric_poll or acentric_next_model. */
ACENTRIC_API int32_t acentric_waiting(const acentric_bundle* bundle);
/* Unloads what a view does not need, farthest from it first, until no more than `bytes` are in memory. */
ACENTRIC_API acentric_status acentric_unload_beyond(acentric_bundle* bundle, const acentric_view* view,
                                                    const acentric_settings* settings, uint64_t bytes);

/* --- Pictures --- */

typedef struct acentric_picture {
  uint8_t* rgba;    /* sRGB, row 0 on top, alpha 255, 0 where a hole is open */
  size_t row_bytes; /* from one row to the next; 0 = 4 * width */
  uint8_t* holes;   /* NULL, or width * height: 255 where nothing is seen (open or filled), else 0 */
  /* NULL, or width * height: metres along the viewing direction; infinite for the sky and holes. */
  float* z_depth;
} acentric_picture;
/* Draws what is loaded; what is not leaves holes. */
ACENTRIC_API acentric_status acentric_render(acentric_bundle* bundle, const acentric_view* view,
                                             const acentric_settings* settings,
                                             const acentric_picture* picture);

/* --- Models: textured triangles for a renderer of one's own, in OpenGL or anything else (since 1.2) --- */

enum { ACENTRIC_OPAQUE = 0, ACENTRIC_MASK = 1, ACENTRIC_BLEND = 2 };

typedef struct acentric_model_vertex {
  float position[3];  /* metres, Z up, from acentric_model.origin */
  float uv[2];        /* (0, 0) is where the texture's first row begins */
  uint16_t colour[4]; /* 0 to 65535 for 0 to 1; the last is 65535 */
} acentric_model_vertex;

/* Triangles of one texture. A pixel shows factor * texture * colour, multiplied as they are linear and shown
 * as sRGB, without light or tone curve: textures are sRGB, colours and factor linear. Where alpha_mode is
 * ACENTRIC_MASK, pixels with alpha below alpha_cutoff are left out. ACENTRIC_BLEND is drawn after all that is
 * not, over it, and writes no depth. */
typedef struct acentric_mesh {
  const char* name; /* of the material, for people */
  uint64_t first_index, index_count;
  int32_t texture, alpha_mode;
  float factor[4], alpha_cutoff; /* 0 where nothing is cut off */
  int32_t double_sided;
  uint32_t roles; /* drawn where a bit of them is among the roles of acentric_need */
} acentric_mesh;

typedef struct acentric_image {
  int32_t width, height, wrap_u, wrap_v, nearest; /* as acentric_texture */
  const uint8_t* rgba;                            /* sRGB, straight alpha, rows downwards */
} acentric_image;

/* Of a capture, or of a region: what is near it, and the sky around the scene. A view is drawn from the
 * models that acentric_view_needs names, in any order, with a depth test. Flat mirrors are open, and what
 * they show lies behind them. */
typedef struct acentric_model {
  double origin[3];
  uint64_t vertex_count, index_count;
  const acentric_model_vertex* vertices;
  const uint32_t* indices; /* of vertices, 3 a triangle, counter-clockwise from the front */
  int32_t mesh_count, texture_count;
  const acentric_mesh* meshes;
  const acentric_image* textures;
} acentric_model;

/* From a model's positions to OpenGL's clip space, column by column, for vectors on the right: `view` from
 * `near` metres on, without an end. */
ACENTRIC_API void acentric_clip_from_model(const acentric_view* view, const double origin[3], double near,
                                           float matrix[16]);

/* `kind` and `number` as of acentric_need; of a region `detail` says nothing. Textures have at
 * most texture_pixels a side, 128 to 16384. Nothing has to be loaded, and nothing is. A model lives until it
 * is freed, whatever is closed. */
ACENTRIC_API acentric_status acentric_make_model(acentric_bundle* bundle, int32_t storey, int32_t kind,
                                                 int32_t number, int32_t detail, int32_t texture_pixels,
                                                 const acentric_model** model);
/* Of any handle, and from any thread. NULL is none. */
ACENTRIC_API void acentric_free_model(const acentric_model* model);

/* Asks for the models of what a view is drawn from, in the background: coarse ones of captures, what is near,
 * then full ones, those nearest first. As acentric_request_view otherwise. Each is handed out once; to have
 * it again, acentric_return_model. */
ACENTRIC_API acentric_status acentric_request_models(acentric_bundle* bundle, const acentric_view* view,
                                                     const acentric_settings* settings,
                                                     int32_t texture_pixels);
typedef struct acentric_arrival {
  int32_t storey, kind, number; /* as of acentric_need */
  int32_t detail;               /* of a capture: the full one takes the place of the coarse one */
  const acentric_model* model;  /* to be freed; NULL: nothing has come, or it failed */
} acentric_arrival;
/* The next that has come; never a coarse one of which the full one is in use. Never waits. An error is of
 * what `arrival` names. */
ACENTRIC_API acentric_status acentric_next_model(acentric_bundle* bundle, acentric_arrival* arrival);
/* It is not in use any more, and comes again when it is needed. Does not free it. */
ACENTRIC_API acentric_status acentric_return_model(acentric_bundle* bundle, const acentric_arrival* arrival);

/* --- Data for a renderer of one's own (FORMAT.md of bundles and of captures tell what it means) --- */

typedef struct acentric_sample {
  /* Bits of a float, the inverse horizontal distance in 1/m, but for the last 8: the roles. */
  uint32_t w_and_roles;
  uint32_t row;
} acentric_sample;

/* Column k has samples [column_start[k], column_start[k + 1]), rows not falling, in a pixel nearest first. */
typedef struct acentric_samples {
  uint64_t count; /* 0: all pointers may be NULL */
  const uint32_t* column_start;
  const acentric_sample* samples;
  const uint8_t* rgba;   /* 4 of each: sRGB after exposure and tone curve, straight alpha */
  const uint8_t* mirror; /* of each the mirror that it belongs to, 0 = none; NULL = none does */
} acentric_samples;

/* A sample lies at centre + (direction of its column, tangent of its row) / w. */
typedef struct acentric_capture_data {
  double centre[3];
  int32_t columns, rows;
  const float* column_direction; /* x, y of each column: unit, at its centre */
  const float* row_tangent;      /* at each row's centre */
  acentric_samples surfaces, reflections;
  uint64_t runs;                       /* of the background */
  const uint32_t* run_start;           /* columns + 1 */
  const uint16_t *run_first, *run_end; /* rows */
  const uint8_t* run_roles;
} acentric_capture_data;
ACENTRIC_API acentric_status acentric_get_capture_data(acentric_bundle* bundle, int32_t storey,
                                                       int32_t camera, int32_t detail,
                                                       acentric_capture_data* out);

typedef struct acentric_local_vertex {
  float position[3];
  float weights[2]; /* of the source triangle's 2nd and 3rd corner */
} acentric_local_vertex;
typedef struct acentric_local_triangle {
  uint32_t vertices[3]; /* counter-clockwise from the front */
  uint32_t mesh;
  uint32_t source; /* triangle of that mesh */
} acentric_local_triangle;
typedef struct acentric_region_data {
  uint64_t vertex_count, triangle_count;
  const acentric_local_vertex* vertices;
  const acentric_local_triangle* triangles;
  int32_t meshes;
} acentric_region_data;
ACENTRIC_API acentric_status acentric_get_region_data(acentric_bundle* bundle, int32_t storey, int32_t region,
                                                      acentric_region_data* out);

/* Source triangles of one material, with their baked light: of triangle t (resolution r > 0) at weights
 * (i / r, j / r), i + j <= r, j fastest, from sample first_sample[t] on; as many again for the back. */
typedef struct acentric_mesh_data {
  int32_t material;
  uint64_t vertex_count, triangle_count;
  const float* positions; /* 3 of each vertex, as normals */
  const float* normals;
  const float* uv0; /* 2 of each, or NULL */
  const float* uv1;
  const uint8_t* colours;       /* 4 of each, linear, or NULL */
  const uint32_t* triangles;    /* 3 vertices each */
  const uint8_t* mirror_plane;  /* of each triangle, 255 = none; or NULL */
  const uint32_t* first_sample; /* of each triangle, into `light`; NULL where no light is baked */
  const uint16_t* resolution;
  const uint8_t* has_back;
  const uint16_t* light; /* 4 halves of each sample: red, green, blue, unused */
} acentric_mesh_data;
ACENTRIC_API acentric_status acentric_get_mesh_data(acentric_bundle* bundle, int32_t storey, int32_t region,
                                                    int32_t mesh, acentric_mesh_data* out);

enum { ACENTRIC_REPEAT = 0, ACENTRIC_CLAMP = 1, ACENTRIC_MIRROR = 2 };
typedef struct acentric_texture {
  int32_t width, height, wrap_u, wrap_v, nearest;
  const uint8_t* rgba; /* sRGB, straight alpha; NULL unless loaded, by a region that uses it */
} acentric_texture;
ACENTRIC_API acentric_status acentric_get_texture(acentric_bundle* bundle, int32_t texture,
                                                  acentric_texture* out);

typedef struct acentric_texture_use {
  int32_t texture, uv_set; /* texture -1: none */
  float rows[2][3];        /* u' = rows[0] . (u, v, 1) */
} acentric_texture_use;
typedef struct acentric_material {
  const char* name;
  float base_colour[4], emissive[3]; /* linear */
  acentric_texture_use base_colour_texture, emissive_texture;
  float metallic, roughness, transmission, alpha_cutoff;
  int32_t alpha_mode, double_sided, unlit;
} acentric_material;
ACENTRIC_API acentric_status acentric_get_material(acentric_bundle* bundle, int32_t material,
                                                   acentric_material* out);

typedef struct acentric_mirror {
  float normal[3], point[3];
} acentric_mirror;
ACENTRIC_API acentric_status acentric_get_mirror(acentric_bundle* bundle, int32_t plane,
                                                 acentric_mirror* out);

#ifdef __cplusplus
}
#endif

#endif
