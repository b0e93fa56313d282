/* Structs and constants that host and kernels share. Plain C, no vectors of three, padding spelled out; the host asserts the
 * sizes and a test kernel writes them back. Lengths are metres in camera space (x right, y up, z towards the viewer). */
#ifndef SPECTRAD_TYPES_H
#define SPECTRAD_TYPES_H

#ifdef __OPENCL_VERSION__
typedef int sd_int;
typedef uint sd_uint;
typedef double sd_double;
#else
#include <cstdint>
typedef std::int32_t sd_int;
typedef std::uint32_t sd_uint;
typedef double sd_double;
#endif

/* Pixels of one row that share a list of terms: the unit of lighting and expansion. */
#define SD_BLOCK 64
/* Screen coordinates are fixed point with 8 bits below the pixel, relative to the image's centre. Vertices further out than
 * SD_GUARD pixels are clipped, so that edge functions of differences (2^24) times positions (2^24) stay below 2^50: exact in
 * 64-bit integers and in doubles. */
#define SD_SUBPIXEL 256
#define SD_GUARD 32768
/* Nearest depth that is seen, metres: only there to keep 1/depth finite. */
#define SD_NEAR 1e-18f
/* Triangles up to this many pixels across are rasterized where they are set up, larger ones by tiles. */
#define SD_SMALL 8
/* Samples of a tile, about: a tile of keys stays in the first-level cache. */
#define SD_TILE_SAMPLES 4096

/* Bits of sd_vertex.outside: beyond which planes of the clip volume a vertex lies. */
#define SD_OUT_NEAR 1
#define SD_OUT_LEFT 2
#define SD_OUT_RIGHT 4
#define SD_OUT_TOP 8
#define SD_OUT_BOTTOM 16

/* The image and the rows being rendered. */
typedef struct sd_frame {
    sd_double pixels_per_slope;   /* perspective: pixels per unit of x/depth; orthographic: pixels per metre */
    float slope_per_subpixel;     /* 1 / (SD_SUBPIXEL * pixels_per_slope) */
    sd_int orthographic;          /* 0 or 1 */
    sd_int width, height;         /* pixels */
    sd_int pitch;                 /* pixels from row to row in all buffers: width rounded up to SD_BLOCK */
    sd_int first_row, rows;       /* the strip */
    sd_int samples;               /* per pixel, as asked for */
    sd_int tile_shift;            /* tiles are 2^tile_shift pixels on a side */
    sd_int tiles_x, tiles_y;
    sd_int pad_;
} sd_frame;

/* How a mesh is placed: object space to camera space, and its cofactor matrix for normals (any length, right side out). */
typedef struct sd_draw {
    sd_double to_camera[12]; /* rows of the affine matrix */
    float normal[9];
    float pad_[3];
} sd_draw;

/* A vertex on the screen. */
typedef struct sd_vertex {
    sd_int x, y;     /* SD_SUBPIXEL-ths of a pixel from the image's centre, y down */
    float depth_key; /* what interpolates linearly on the screen: 1/depth (perspective) or depth (orthographic), > 0 */
    sd_int outside;  /* SD_OUT_ bits; x, y mean nothing unless 0 */
} sd_vertex;

/* A triangle that goes through the tiles: counter-clockwise in edge-function sense (twice its area > 0). */
typedef struct sd_large {
    sd_int x[3], y[3];
    sd_uint id;
    float key_min, key_max;     /* of the corners: interpolation never leaves them */
    sd_uint pad_;
    sd_double key, key_x, key_y; /* depth key = key + key_x (x - x[0]) + key_y (y - y[0]) */
} sd_large;

#define SD_LIGHT_POINT 1
#define SD_LIGHT_SPOT 2
#define SD_LIGHT_DIRECTIONAL 3
#define SD_LIGHT_AMBIENT 4

typedef struct sd_light {
    float x, y, z;              /* point, spot: position; directional: unit vector towards the light */
    sd_int type;
    float axis_x, axis_y, axis_z; /* spot: unit vector along which it shines */
    float cos_outer;            /* spot: cosine of half the cone */
    float inv_cos_range;        /* spot: 1 / (cos_inner - cos_outer); a cone with a hard edge has a huge value here */
    float scale;                /* of the group's spectrum */
    sd_uint group;              /* lights of one spectrum share a group, and with it their terms */
    sd_int pad_;
} sd_light;

#define SD_LOBE_EMISSION 1 /* one term */
#define SD_LOBE_DIFFUSE 2  /* the lobes below have a term for each light group */
#define SD_LOBE_COATED 3   /* Lambert under a dielectric coat */
#define SD_LOBE_COAT 4     /* GGX dielectric reflection of the coat */

typedef struct sd_lobe {
    sd_int type;
    sd_uint term;       /* of the lobe's first term within its material */
    float alpha;        /* GGX width, roughness squared; 0: a mirror */
    float ior;          /* of the coat */
    sd_uint table;      /* first entry in the albedo tables */
    float multiple;     /* factor of the coat's multiple-scattering lobe (Kulla & Conty 2017) */
    float mean_through; /* 1 - cosine-weighted mean of the coat's albedo */
    float weight;       /* of a lobe evaluated at one of several indices (dispersion); else 1 */
} sd_lobe;

/* Entries of an albedo table, uniform in the cosine from 0 to 1: what the coat lets through, and what single scattering misses. */
#define SD_TABLE_CELLS 1024
typedef struct sd_albedo {
    float through; /* 1 - albedo(cos) */
    float missing; /* 1 - albedo(cos) of the same microfacets if they reflected everything */
} sd_albedo;

typedef struct sd_material {
    sd_uint first_lobe, lobes;
    sd_uint first_term, terms;
} sd_material;

#ifndef __OPENCL_VERSION__
static_assert(sizeof(sd_frame) == 56 && sizeof(sd_draw) == 144 && sizeof(sd_vertex) == 16 && sizeof(sd_large) == 64 + 0 &&
                  sizeof(sd_light) == 48 && sizeof(sd_lobe) == 32 && sizeof(sd_albedo) == 8 && sizeof(sd_material) == 16,
              "layout shared with the kernels");
#endif

#endif
