/* What a surface does with light, lobe by lobe: bidirectional reflectance without its spectrum. Each lobe adds its g to one or more
 * terms; HAS_ switches leave out what the plan does not need. */
#include "texture.h"

#define INV_PI 0.31830988618379067f
/* Tables of a function of a direction. */
#ifdef HAS_ANISOTROPY
#define COEFFICIENTS(lobe) ((lobe).alpha_v != 0.0f ? SD_AZIMUTHS : 1)
#else
#define COEFFICIENTS(lobe) 1
#endif

/* Where a cosine falls in the tables: the piece of each lane and the place within. */
typedef struct table_cell {
    vint cell;
    vfloat t;
} table_cell;

#if defined(HAS_ROUGH) || defined(HAS_COATED) || defined(HAS_FACETS) || defined(HAS_MAPPING)
static inline table_cell cell_of(vfloat cosine) {
    /* Lanes that see something else may hold NaN here: fmax() makes them 0, clamp() need not. */
    const vfloat at = sqrt(fmin(fmax(cosine, 0.0f), 1.0f)) * (float)SD_CELLS;
    table_cell c;
    c.cell = min(V_INT(at), (vint)(SD_CELLS - 1));
    c.t = at - V_FLOAT(c.cell);
    return c;
}

/* A tabulated function of the cosine: lanes fetch their own pieces. */
static vfloat look_up(global const sd_piece* table, table_cell at) {
    int cells[VW];
    float c0[VW], c1[VW], c2[VW], c3[VW];
    VSTORE(at.cell, cells);
    for (int i = 0; i < VW; ++i) {
        const float4 c = vload4(0, table[cells[i]].c);
        c0[i] = c.x, c1[i] = c.y, c2[i] = c.z, c3[i] = c.w;
    }
    return fma(at.t, fma(at.t, fma(at.t, VLOAD(c3), VLOAD(c2)), VLOAD(c1)), VLOAD(c0));
}
#endif

#include "azimuth.h"

/* What a lobe needs of the view direction, the same under all lights. */
typedef struct lobe_view {
    vfloat first; /* the lobe's first function at the view: through, 1 - albedo, or missing */
    table_cell cell;
#ifdef HAS_ANISOTROPY
    vfloat azimuth;
#endif
} lobe_view;

#if defined(HAS_ROUGH) || defined(HAS_COATED) || defined(HAS_FACETS)
/* The lobe's first function at a light, or another that lies at `table`. */
static vfloat first_at(sd_lobe lobe, global const sd_piece* table, surface s, v3 to_light, vfloat cos_light) {
#ifdef HAS_ANISOTROPY
    if (lobe.alpha_v != 0.0f)
        return fmax(look_up_round(table, cell_of(cos_light), azimuth_of(lobe, local_of(s, to_light))), 0.0f);
#endif
    return look_up(table, cell_of(cos_light));
}
#endif

static lobe_view view_of(sd_lobe lobe, global const sd_piece* tables, surface s) {
    lobe_view v;
    v.first = 0.0f;
    v.cell.cell = 0;
    v.cell.t = 0.0f;
#if defined(HAS_ROUGH) || defined(HAS_COATED) || defined(HAS_FACETS)
    if (lobe.type != SD_LOBE_DIFFUSE) {
        v.cell = cell_of(s.cos_view);
#ifdef HAS_ANISOTROPY
        v.azimuth = 0.0f;
        if (lobe.alpha_v != 0.0f) {
            v.azimuth = azimuth_of(lobe, local_of(s, s.view));
            v.first = fmax(look_up_round(tables + lobe.table, v.cell, v.azimuth), 0.0f);
            return v;
        }
#endif
        v.first = look_up(tables + lobe.table, v.cell);
    }
#endif
    return v;
}

/* Where textures are. */
typedef struct paint {
    global const sd_texture* textures;
    global const float* texels;
    float samples; /* of a pixel */
} paint;

#ifdef HAS_TEXTURE
/* g where only a part of the surface has the lobe. */
static inline vfloat masked(sd_lobe lobe, paint p, surface s, vfloat g, vint mask) {
    if (lobe.strength == 0) return g;
    texture_view view;
    look_at_texture(p.textures[lobe.strength - 1], s, mask, p.samples, &view);
    return g * texture_band(p.texels, &view, 0);
}
#endif

/* A diffuse lobe's g, times its textures if it has any. */
static inline void add_painted(sd_lobe lobe, paint p, surface s, vfloat g, vint mask, uint groups, global float* term) {
#ifdef HAS_TEXTURE
    g = masked(lobe, p, s, g, mask);
    if (lobe.texture != 0) {
        add_textured(p.textures[lobe.texture - 1], p.texels, s, g, mask, p.samples, groups, lobe.steps, lobe.inside, -1.0f, term);
        return;
    }
#endif
    add_to(term, select((vfloat)0.0f, g, mask));
}

#ifdef HAS_ROUGH
/* The same for one part of a rough diffuse lobe, by that part's function of the reflectance; returns where the next part's terms are. */
static inline global float* add_part(sd_lobe lobe, paint p, surface s, vfloat g, vint mask, uint groups, int steps, float inside,
                                     float second, global float* term) {
#ifdef HAS_TEXTURE
    if (lobe.texture != 0) {
        const sd_texture t = p.textures[lobe.texture - 1];
        add_textured(t, p.texels, s, g, mask, p.samples, groups, steps, inside, second, term);
        return term + (size_t)((t.bands - 1) * steps + 1) * groups * SD_BLOCK;
    }
#endif
    add_to(term, select((vfloat)0.0f, g, mask));
    return term + groups * SD_BLOCK;
}

/* Single and multiple scattering, whose terms have the reflectance and what is left of its square; returns where terms go on. */
static inline global float* add_rough(sd_lobe lobe, paint p, surface s, vfloat single, vfloat multiple, vint mask, uint groups,
                                      global float* term) {
    term = add_part(lobe, p, s, single, mask, groups, 1, 0.0f, 0.0f, term);
    return add_part(lobe, p, s, multiple, mask, groups, lobe.steps, lobe.inside, 0.0f, term);
}

/* Oren & Nayar 1994 by its ratio B/A, in the form that keeps energy (Portsmouth, Kutz & Hill 2024): single scattering and, as a
 * term of its own because it reddens, multiple scattering. */
static void rough(sd_lobe lobe, global const sd_piece* tables, surface s, v3 to_light, vfloat cos_light, vfloat irradiance,
                  uint groups, lobe_view at_view, vint lit, paint p, global float* term) {
    const vfloat beyond = fma(-cos_light, s.cos_view, dot3(to_light, s.view));
    const vfloat divisor = select((vfloat)1.0f, fmax(cos_light, s.cos_view), beyond > 0.0f);
    const vfloat single = lobe.mean_through * fma((vfloat)lobe.alpha, beyond / divisor, (vfloat)1.0f);
    const vfloat missing_light = look_up(tables + lobe.table, cell_of(cos_light));
    add_rough(lobe, p, s, irradiance * single, irradiance * (at_view.first * missing_light * lobe.multiple), lit, groups, term);
}
#endif

#ifdef HAS_ROUGH_COATED
/* A direction below the coat, by Snell's law. */
typedef struct below {
    vfloat cosine, missing, back; /* and its tables: 1 - albedo; share that the coat sends back */
} below;

static below below_coat(sd_lobe lobe, global const sd_piece* tables, vfloat cosine) {
    global const sd_piece* own = tables + lobe.table + COEFFICIENTS(lobe) * SD_CELLS;
    const table_cell at = cell_of(cosine);
    below b;
    b.cosine = sqrt(fma((vfloat)lobe.inv_n2, fma(cosine, cosine, (vfloat)-1.0f), (vfloat)1.0f));
    b.missing = look_up(own, at);
    b.back = look_up(own + SD_CELLS, at);
    return b;
}

/* The same below a coat, for light that is let through, scattered and let through again; what the coat sends back to the base first is
 * diffuse, and has terms of its own. */
static void rough_coated(sd_lobe lobe, global const sd_piece* tables, surface s, v3 to_light, vfloat cos_light, vfloat irradiance,
                         uint groups, lobe_view at_view, vint lit, paint p, global float* term) {
    const below view = below_coat(lobe, tables, s.cos_view), light = below_coat(lobe, tables, cos_light);
    const vfloat beyond = fma(-cos_light, s.cos_view, dot3(to_light, s.view)) * lobe.inv_n2;
    const vfloat divisor = select((vfloat)1.0f, fmax(light.cosine, view.cosine), beyond > 0.0f);
    const vfloat through = irradiance * (at_view.first * first_at(lobe, tables + lobe.table, s, to_light, cos_light)) * lobe.inv_n2;
    const vfloat single = lobe.mean_through * fma((vfloat)lobe.ratio, beyond / divisor, (vfloat)1.0f);
    term = add_rough(lobe, p, s, through * single, through * (view.missing * light.missing * lobe.multiple), lit, groups, term);
    add_part(lobe, p, s, through * (view.back * light.back * lobe.rest), lit, groups, lobe.steps, lobe.inside_rest, lobe.second_rest, term);
}
#endif

#ifdef HAS_FACETS
/* GGX (Walter et al. 2007) with height-correlated Smith shadowing (Heitz 2014), and what bounces more than once between facets
 * (Kulla & Conty 2017). 1 - (n.h)^2 is taken as |n x h|^2, which keeps its digits on smooth surfaces. */
static void facets(sd_lobe lobe, global const sd_piece* tables, surface s, v3 to_light, vfloat cos_light, vfloat irradiance,
                   uint groups, lobe_view at_view, vint lit, global float* term) {
    if (lobe.alpha == 0.0f) return; /* a mirror shows no point of light that has no size */
    const v3 h = unit3(add3(to_light, s.view));
    const vfloat cos_half = dot3(s.normal, h), cos_diff = clamp(dot3(s.view, h), 0.0f, 1.0f);
    float a2 = lobe.alpha * lobe.alpha;
    vfloat width, shadow_view, shadow_light;
#ifdef HAS_ANISOTROPY
    if (lobe.alpha_v != 0.0f) {
        /* Burley 2012, Heitz 2014: an ellipse of slopes. */
        const v3 l = local_of(s, to_light), v = local_of(s, s.view), m = local_of(s, h);
        const float u2 = a2, v2 = lobe.alpha_v * lobe.alpha_v, flat = lobe.alpha_v / lobe.alpha;
        a2 = lobe.alpha * lobe.alpha_v;
        width = fma(m.x * m.x, (vfloat)flat, fma(m.y * m.y, (vfloat)(1.0f / flat), cos_half * cos_half * a2));
        shadow_view = cos_light * sqrt(fma(v.x * v.x, (vfloat)u2, fma(v.y * v.y, (vfloat)v2, s.cos_view * s.cos_view)));
        shadow_light = s.cos_view * sqrt(fma(l.x * l.x, (vfloat)u2, fma(l.y * l.y, (vfloat)v2, cos_light * cos_light)));
    } else
#endif
    {
        const v3 across = cross3(s.normal, h);
        width = fma(cos_half * cos_half, (vfloat)a2, dot3(across, across));
        shadow_view = cos_light * sqrt(fma(s.cos_view * s.cos_view, (vfloat)(1.0f - a2), (vfloat)a2));
        shadow_light = s.cos_view * sqrt(fma(cos_light * cos_light, (vfloat)(1.0f - a2), (vfloat)a2));
    }
    /* Not width squared: of a surface of roughness 1e-8 that is 1e-64. */
    const vfloat shape = (a2 / width) * (INV_PI / width) * 0.5f / (shadow_view + shadow_light) * irradiance;
    const vfloat multiple = at_view.first * first_at(lobe, tables + lobe.table, s, to_light, cos_light) * lobe.multiple * irradiance;
    const table_cell facing = cell_of(cos_diff);
    global const sd_piece* fresnel = tables + lobe.table + (1 + lobe.functions) * COEFFICIENTS(lobe) * SD_CELLS;
    for (uint f = 0; f < lobe.functions; ++f) {
        vfloat g = shape * look_up(fresnel + f * SD_CELLS, facing);
        if (f == lobe.multiple_to) g += multiple;
        add_to(term + f * groups * SD_BLOCK, select((vfloat)0.0f, g, lit));
    }
    if (lobe.multiple_to == lobe.functions) add_to(term + lobe.functions * groups * SD_BLOCK, select((vfloat)0.0f, multiple, lit));
}
#endif

#ifdef HAS_UNIFORM
/* Light of one radiance from everywhere: directional albedos instead of directions. */
static void uniform_light(sd_lobe lobe, global const sd_piece* tables, float scale, uint groups, lobe_view at_view, surface s,
                          vint mask, paint p, global float* term) {
    switch (lobe.type) {
        case SD_LOBE_DIFFUSE: add_painted(lobe, p, s, scale, mask, groups, term); break;
#ifdef HAS_ROUGH
        case SD_LOBE_ROUGH:
            add_rough(lobe, p, s, scale * (1.0f - at_view.first), scale * at_view.first, mask, groups, term);
            break;
#endif
#ifdef HAS_ROUGH_COATED
        case SD_LOBE_ROUGH_COATED: {
            const below view = below_coat(lobe, tables, s.cos_view);
            const vfloat through = scale * at_view.first, multiple = view.missing * lobe.escape;
            term = add_rough(lobe, p, s, through * fmax(1.0f - view.back - multiple, 0.0f), through * multiple, mask, groups, term);
            add_part(lobe, p, s, through * view.back, mask, groups, lobe.steps, lobe.inside_rest, lobe.second_rest, term);
            break;
        }
#endif
#ifdef HAS_COATED
        case SD_LOBE_COATED: add_painted(lobe, p, s, scale * at_view.first * lobe.mean_through, mask, groups, term); break;
#endif
#ifdef HAS_FACETS
        case SD_LOBE_FACETS: {
            global const sd_piece* albedo = tables + lobe.table + COEFFICIENTS(lobe) * SD_CELLS;
            for (uint f = 0; f < lobe.functions; ++f) {
#ifdef HAS_ANISOTROPY
                const vfloat back = lobe.alpha_v != 0.0f
                                        ? look_up_round(albedo + f * SD_AZIMUTHS * SD_CELLS, at_view.cell, at_view.azimuth)
                                        : look_up(albedo + f * SD_CELLS, at_view.cell);
#else
                const vfloat back = look_up(albedo + f * SD_CELLS, at_view.cell);
#endif
                add_to(term + f * groups * SD_BLOCK, select((vfloat)0.0f, scale * INV_PI * back, mask));
            }
            if (lobe.multiple_to == lobe.functions)
                add_to(term + lobe.functions * groups * SD_BLOCK, select((vfloat)0.0f, scale * INV_PI * at_view.first, mask));
            break;
        }
#endif
        default: break;
    }
}
#endif
