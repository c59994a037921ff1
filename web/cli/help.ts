/** What `--help` prints. README.md in this folder says the same in more words. */

const EXIT_CODES = `Exit codes
  0  done
  1  a defect of the command, or no WebAssembly
  2  arguments that cannot be meant
  3  an input file that cannot be read, or is not what its format asks for
  4  content that is refused: a mesh, a handle, a body that does not fit
  5  an output file that cannot be written
  130  interrupted

An error says what is wrong, what to do about it and its stable code on standard error; with --json it is { "error": { code, message,
remedy, culprit? } } on standard output. Progress and warnings go to standard error. Output is read back before it is put
in place, written whole or not at all, and the same input gives the same bytes.`;

const READING = `  --strict             refuse an OBJ, PLY, STL or OFF that contradicts its format, where else a warning says what was passed over`;

const WRITING = `  -o, --output FILE    where to write; an older file is replaced, the input itself only with --force; - is standard output, and
                       what is said goes to standard error then
  -f, --force          let the output replace an input`;

const COMMON = `  --json               print one JSON object on standard output
  -q, --quiet          no progress, no warnings, no summary: errors only
  -h, --help           this text`;

export const HELP: Record<string, string> = {
  '': `Deforms shapes by scattered interpolation.

  handlebody bake MODEL.(glb|gltf|obj|ply|stl|off) -o BODY.glb [--quality QUALITY] [--distance METHOD] [--json]
  handlebody deform BODY.glb --handles HANDLES.json -o OUT.glb [--json]
  handlebody pose FACE.glb --at valence=0.6,arousal=0.4 -o OUT.glb [--json]
  handlebody inspect FILE [--json]
  handlebody embed NAME|BODY.glb|FACE.glb -o FILE.html [--state STATE] [--title TEXT] [--json]

  handlebody COMMAND --help tells more of each; --version prints the version.
  A model called - is standard input, and so are handles.

${EXIT_CODES}`,

  bake: `Computes a model's interior distances and writes it with them: once, whatever handles it gets later.

  handlebody bake MODEL.(glb|gltf|obj|ply|stl|off) -o BODY.glb

  --quality QUALITY    draft, normal (the default) or fine: how many voxels and digits the distances get, and so how large the file is
  --centers N          how many centers the deformation may bend at (by default as many as limbs and spheres need)
  --distance METHOD    fast-marching (the default), heat, mean-value or euclidean
  --morphs WHICH       rest (the default) or present: with what the file's morph weights add
  --resolution N       voxels along the longest side, 8 to 512 (by default by the quality and by how much is inside)
  --spheres N          at most so many spheres (by default by how many branches the skeleton has)
  --packing PACKING    how spheres fill the volume: skeleton (the default), tree or medial
  --level N            of the tree, 1 to 10 (by default the deepest that gives no more spheres than are allowed)
  --overlap N          how much spheres may overlap, in parts of the smaller radius: -4 to 1, below 0 they keep apart (by default 0)
  --smallest-radius N  of the spheres, as a part of the diagonal (by default by the voxels)
  --bones              ellipsoids in the place of spheres where limbs are straight: they bend at their joints only
${READING}
${WRITING}
${COMMON}

Vertices keep their order and number, and a GLB its materials, UVs, skins and morph targets. Bake last: what moves or reorders vertices
afterwards makes the distances worthless, and is found out.

${EXIT_CODES}`,

  deform: `Bends a baked model by handles.

  handlebody deform BODY.glb --handles HANDLES.json -o OUT.glb

  --handles FILE       which points are held, and where they go
${WRITING}
${COMMON}

HANDLES.json, in the model's own units after its nodes' transforms:

  { "handles": [
      { "vertex": 120, "to": [0.1, 0.6, 0] },
      { "at": [0, 0.5, 0], "to": [0, 0.5, 0], "rotation": [0, 0, 0.383, 0.924], "scale": [1, 1, 1] }
    ],
    "relativeWidth": "auto", "smoothness": "auto", "poissonRatio": 0.4, "sphereFit": "rigid", "structure": "octahedron",
    "shapes": { "7": [1.5, 0, 0, 0, 1, 0, 0, 0, 1] } }

A handle sits on a vertex (POSITION as stored, primitives one after another in scene order; in OBJ, PLY and OFF, in the order of the
file; in STL, in the order in which places come first) or at any point inside, and goes to "to". "rotation" (a quaternion x, y, z, w) and
"scale" are kept free where neither is given. "shapes" gives spheres another shape: the rows of a linear map of the sphere at rest.
With "sphereFit": "similarity" spheres may grow; with "structure": "icosahedron" they feel bends, too. The output is no longer the shape that was baked, and carries no interior distances. A
skinned model's rest shape is deformed, before skinning.

${EXIT_CODES}`,

  pose: `Sets the morph targets of a model to a place in its pose space.

  handlebody pose FACE.glb --at valence=0.6,arousal=0.4 -o OUT.glb

  --at NAME=X,…        one number for every dimension; "handlebody inspect" lists them
  --mesh NAME          which mesh, where several have a pose space: its name, or its number from 0 as "handlebody inspect" tells it
                       (name:2 for a mesh whose name is 2)
${WRITING}
${COMMON}

With --json, "weights" are those of the examples and "targets" those of the morph targets.

${EXIT_CODES}`,

  embed: `Writes one live figure, or one model with its element, as a single page that works from the disk, with no network.

  handlebody embed NAME -o FILE.html          a figure: course-12, or course-12#v1&narrow with its state
  handlebody embed BODY.glb -o FILE.html      a model to drag; one that is not baked is baked by the page, each time it opens
  handlebody embed FACE.glb -o FILE.html      a model with a pose space, which its plane and sliders move

  --state STATE        the figure's, as its link has it behind the name: v1&narrow
  --title TEXT         the page's, and a model's description (the figure's own title, or the model's file name)
${WRITING}
${COMMON}

A figure is named as in the site's embed.html. The page holds the program, the solver and the model; their licenses are at its end.

${EXIT_CODES}`,

  inspect: `Tells what is in a model: its surface, its baked body, its pose spaces. Any GLB, glTF, OBJ, PLY, STL or OFF will do.

  handlebody inspect FILE

${READING}
${COMMON}

${EXIT_CODES}`,
};
