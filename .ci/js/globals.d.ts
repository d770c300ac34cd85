// Scripts of the page that are no modules.
declare var Blockly: any;
declare var python: any;
