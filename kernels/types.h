/* Structs and constants that host and kernels share. Plain C, no vectors of three, padding spelled out; the host asserts the
 * sizes and a test kernel writes them back. Lengths are metres in camera space (x right, y up, z towards the viewer). */
#ifndef SPECTRAD_TYPES_H
#define SPECTRAD_TYPES_H

#ifdef __OPENCL_VERSION__
typedef int sd_int;
typedef uint sd_uint;
typedef ulong sd_ulong;
typedef double sd_double;
#else
#include <cstdint>
typedef std::int32_t sd_int;
typedef std::uint32_t sd_uint;
typedef std::uint64_t sd_ulong;
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
/* Triangles that a work-item of a CPU takes of those: their keys come from memory while others are set up. */
#define SD_BATCH 16
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
    float to_world[9];            /* rotation from camera space to the world's axes, rows */
    sd_int baked;                 /* 1: the image is the square of texture coordinates, its surfaces lit where they stand (BAKE) */
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
#define SD_LIGHT_SURROUNDINGS 5 /* the background, where no ambient light is: only mirrors show it */

typedef struct sd_light {
    float x, y, z;              /* point, spot: position; directional: unit vector towards the light */
    sd_int type;
    float axis_x, axis_y, axis_z; /* spot: unit vector along which it shines */
    float chord_outer;          /* spot: squared chord of half the cone on the unit sphere, 2 (1 - cosine): keeps its digits at any angle */
    float inv_chord_range;      /* spot: 1 / (chord_outer - chord_inner); a cone with a hard edge has a huge value here */
    float scale;                /* of the group's spectrum */
    sd_uint group;              /* lights of one spectrum share a group, and with it their terms */
    sd_int shadows;             /* 1: surfaces hide it (HAS_SHADOWS) */
} sd_light;

/* What throws shadows stands in a binary tree of boxes: node n has the children 2n and 2n + 1, the leaves are the nodes from `leaves`
 * (a power of two) on, leaf k holds the casters from k * casters / leaves up to the next leaf's first. */
#define SD_LEAF_CASTERS 4

#define SD_LOBE_EMISSION 1 /* one term */
#define SD_LOBE_DIFFUSE 2  /* Lambert; this and the lobes below have a term for each light group */
#define SD_LOBE_ROUGH 3    /* Oren-Nayar: a term for single and one for multiple scattering */
#define SD_LOBE_COATED 4   /* Lambert under a coat */
#define SD_LOBE_REFLECTION 6 /* a mirror's image: functions of the angle times the bands of an image; no lights */
#define SD_LOBE_ROUGH_COATED 7 /* Oren-Nayar under a coat: terms for single and multiple scattering, and for what comes back from the coat */
#define SD_LOBE_FACETS 5   /* GGX microfacets whose Fresnel reflectance is a sum of functions of the angle */

/* Functions of a cosine are cubics on cells uniform in the square root of the cosine, which keeps grazing angles apart:
 * f = c[0] + t (c[1] + t (c[2] + t c[3])), t in 0..1 within the cell. A function has SD_CELLS pieces. */
#define SD_CELLS 256
typedef struct sd_piece {
    float c[4];
} sd_piece;

/* Where a surface is rougher along one axis than along the other (alpha_v != 0), functions of a direction are polynomials in a
 * number x of its azimuth (kernels/azimuth.h), SD_AZIMUTHS coefficients from the constant on, each a table as above. */
#define SD_AZIMUTHS 8

/* Tables of a lobe, each SD_CELLS pieces from `table` on.
 *   COATED: what the coat lets through, out at `table` and in at `table_light`.
 *   ROUGH:  1 - directional albedo of single scattering.
 *   ROUGH_COATED: what the coat lets through; then, of the direction below the coat that belongs to the one above, 1 - directional
 *           albedo of single scattering; and the share of what a white base scatters that the coat sends back to it.
 *   REFLECTION: `functions` Fresnel factors over the cosine of the view.
 *   FACETS: 1 - directional albedo were the facets perfect mirrors ("missing"); then `functions` directional albedos; then
 *           `functions` Fresnel factors over the cosine between view and facet. */
typedef struct sd_lobe {
    sd_int type;
    sd_uint term;        /* of the lobe's first term within its material; terms run [function][light group] */
    sd_uint table;       /* first piece */
    sd_uint table_light; /* COATED: the same of what is let in; another than `table` where light changes its wavelength below the coat */
    sd_uint functions;   /* FACETS: how many */
    sd_uint multiple_to; /* FACETS: the function whose terms take multiple scattering; == functions: terms of their own */
    float multiple;      /* factor of missing(view) missing(light), 1/sr; ROUGH, ROUGH_COATED: 1 / (1 - mean albedo) */
    float alpha;         /* FACETS: GGX width, roughness squared, 0 a mirror; ROUGH: B / A of Oren and Nayar */
    float mean_through;  /* COATED: cosine-weighted mean of what is let in; ROUGH, ROUGH_COATED: A */
    sd_uint texture;     /* DIFFUSE, COATED, ROUGH: 1 + number of the texture that paints the lobe; 0: none */
    sd_uint strength;    /* the same: 1 + number of the texture whose one band multiplies g; 0: none */
    sd_int steps;        /* of a painted lobe: terms for each interval between bands, see texture.h */
    float inside;        /* COATED: reflectance of the coat from inside; ROUGH, ROUGH_COATED: 1 - mean albedo; 0: linear in the texel */
    sd_uint mapping;     /* of the texture: SD_MAP_ */
    float alpha_v;       /* FACETS, and what lies under such: GGX width across the texture's u where alpha is the one along it; 0: alpha all round */
    /* ROUGH_COATED: */
    float ratio;         /* B / A */
    float inv_n2;        /* 1 / the coat's index squared */
    float escape;        /* of what is scattered more than once: mean share that gets out at once, by the table of 1 - albedo */
    float rest;          /* 1 / mean over the directions that get out of the share that is sent back */
    float inside_rest, second_rest; /* the texel's functions for what is sent back, see texture.h */
} sd_lobe;

#define SD_MAP_SURFACE 0 /* the surface's coordinates */
#define SD_MAP_PICTURE 1 /* the place in the picture that is rendered */
#define SD_MAP_CUBE 2    /* the direction: six faces one below the other */

/* A texture: texels[first + (row * width + column) * bands + band], row 0 on top; then, for SD_MIP, levels of half the size each.
 * Bands are reflectances at wavelengths, shares of measured spectra, a strength or directions. A lobe that is painted has terms
 * [band][step][light group]; with ROUGH those of single scattering, [band][light group], come first. */
#define SD_NEAREST 0
#define SD_BILINEAR 1
#define SD_MIP 2
#define SD_CLAMP 0
#define SD_REPEAT 1
typedef struct sd_texture {
    sd_ulong first;
    sd_int width, height, bands;
    sd_int filter, wrap;
    sd_int levels;
    float place[6]; /* u = place[0] u + place[1] v + place[2] of the surface's coordinates, v = place[3] u + place[4] v + place[5] */
} sd_texture;

typedef struct sd_material {
    sd_uint first_lobe, lobes;
    sd_uint first_term, terms;
    sd_uint relief; /* 1 + number of the texture that bends the normal: 3 bands, directions in the frame of the texture's coordinates;
                       2 bands, slopes in metres per unit of them; 0: none */
    sd_uint pad_;
} sd_material;

/* What a display makes of linear Rec.709: its own linear signals. */
#define SD_SHOW_CELLS 4096
typedef struct sd_show {
    float to_signal[9]; /* rows */
} sd_show;

#ifndef __OPENCL_VERSION__
static_assert(sizeof(sd_frame) == 96 && sizeof(sd_draw) == 144 && sizeof(sd_vertex) == 16 && sizeof(sd_large) == 64 + 0 &&
                  sizeof(sd_light) == 48 && sizeof(sd_lobe) == 84 && sizeof(sd_texture) == 56 && sizeof(sd_piece) == 16 && sizeof(sd_material) == 24 &&
                  sizeof(sd_show) == 36,
              "layout shared with the kernels");
#endif

#endif
