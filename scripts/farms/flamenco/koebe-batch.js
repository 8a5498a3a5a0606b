// SPDX-License-Identifier: GPL-3.0-or-later
// A job type of Flamenco: every file of a library mapped by a task of its own, then the table.
//
// Put this file into the folder "scripts" beside the manager's program; the job type is then called koebe-batch.
// `koebe batch LIBRARY --output RESULTS --list` prints what the setting `files` takes.

const JOB_TYPE = {
    label: "Koebe UV: map a library",
    settings: [
        { key: "files", type: "string", required: true, visible: "submission",
          description: "One line for each file: its folder, a tab, its name below that folder; as `koebe batch … --list` prints them" },
        { key: "output", type: "string", subtype: "dir_path", required: true, visible: "submission",
          description: "Folder for the results; all workers have to see it, and the files, under the same paths" },
        { key: "command", type: "string", default: "koebe", visible: "submission",
          description: "The koebe command of the workers" },
        { key: "blender", type: "string", default: "", visible: "submission",
          description: "The Blender of the workers, for .blend files; empty: there are none" },
        { key: "options", type: "string", default: "", visible: "submission",
          description: "Options of koebe batch, one in each line: --method=ck" },
        { key: "time_limit", type: "int32", default: 0, visible: "submission",
          description: "Seconds for a file; 0: none" },
        { key: "files_in_task", type: "int32", default: 1, visible: "submission",
          description: "More for small meshes" },
    ],
};

function lines(text) {
    return text.split("\n").map(line => line.replace(/\r$/, "")).filter(line => line.length > 0);
}

// Task for task it is the same command: `koebe batch` on single files, which are named as in a run on the whole folder.
// A mesh that cannot be mapped is a row of the table and no failure of the task; a machine that fails is one.
function compileJob(job) {
    const settings = job.settings;
    const common = ["--output", settings.output].concat(lines(settings.options));
    if (settings.blender) common.push("--blender=" + settings.blender);
    const once = common.concat(["--workers=1", "--no-summary", "--exit-zero"]);
    if (settings.time_limit > 0) once.push("--time-limit=" + settings.time_limit);

    const files = lines(settings.files).map(line => line.split("\t"));
    if (files.length === 0) throw new Error("there is no file in the setting `files`");
    for (const file of files)
        if (file.length !== 2 || !file[0] || !file[1])
            throw new Error("a line of the setting `files` is no folder, tab and name: " + file.join("\t"));

    const tableTask = author.Task("table", "misc");
    const step = Math.max(1, settings.files_in_task);
    for (let begin = 0; begin < files.length; begin += step) {
        const some = files.slice(begin, begin + step);
        const name = some.length === 1 ? some[0][1] : some[0][1] + " and " + (some.length - 1) + " more";
        const task = author.Task(name, settings.blender ? "blender" : "misc");
        for (const [folder, file] of some) {
            task.addCommand(author.Command("exec", {
                exe: settings.command,
                args: ["batch", folder + "/" + file, "--base", folder].concat(once),
            }));
        }
        tableTask.addDependency(task);
        job.addTask(task);
    }
    const [folder, file] = files[0];
    tableTask.addCommand(author.Command("exec", {
        exe: settings.command,
        args: ["batch", folder + "/" + file, "--base", folder].concat(common, ["--summary-only"]),
    }));
    job.addTask(tableTask);
}
