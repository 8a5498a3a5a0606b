// Compiles a job with a Flamenco job type, in the engine that Flamenco's manager embeds, and prints its tasks as JSON.
//
// Usage: compile_job JOB_TYPE.js SETTINGS.json
//
// Of the manager's own objects those are here that job types are documented to use: author.Task, author.Command,
// job.settings, job.addTask, task.addCommand, task.addDependency. Settings that are missing get their defaults, and one
// that is required or of another type is an error, as in the manager.
package main

import (
	"encoding/json"
	"fmt"
	"os"

	"github.com/dop251/goja"
)

const stubs = `
const tasks = [];
const author = {
    Command: (name, parameters) => ({name, parameters}),
    Task: (name, type) => ({
        name, type, commands: [], dependencies: [],
        addCommand(command) { this.commands.push(command); },
        addDependency(task) { this.dependencies.push(task.name); },
    }),
};
`

const compile = `
const kinds = {string: "string", int32: "number", float: "number", bool: "boolean"};
const known = new Set();
for (const setting of JOB_TYPE.settings) {
    const {key, type, required} = setting;
    if (!kinds[type]) throw new Error("a setting of type " + type);
    known.add(key);
    if (given[key] === undefined && required) throw new Error("the setting " + key + " is missing");
    if (given[key] === undefined) given[key] = "default" in setting ? setting.default : {string: "", number: 0, boolean: false}[kinds[type]];
    if (typeof given[key] !== kinds[type]) throw new Error("the setting " + key + " is no " + type);
}
for (const key of Object.keys(given)) if (!known.has(key)) throw new Error("no setting is called " + key);
compileJob({settings: given, addTask(task) { tasks.push(task); }});
JSON.stringify({label: JOB_TYPE.label, tasks});
`

func run() error {
	script, err := os.ReadFile(os.Args[1])
	if err != nil {
		return err
	}
	settings, err := os.ReadFile(os.Args[2])
	if err != nil {
		return err
	}
	var given map[string]interface{}
	if err := json.Unmarshal(settings, &given); err != nil {
		return err
	}
	engine := goja.New()
	if err := engine.Set("given", given); err != nil {
		return err
	}
	if _, err := engine.RunString(stubs); err != nil {
		return err
	}
	if _, err := engine.RunScript(os.Args[1], string(script)); err != nil {
		return err
	}
	result, err := engine.RunString(compile)
	if err != nil {
		return err
	}
	fmt.Println(result.String())
	return nil
}

func main() {
	if err := run(); err != nil {
		fmt.Fprintln(os.Stderr, err)
		os.Exit(1)
	}
}
